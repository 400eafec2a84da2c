#include "diagnosis/record/settling.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "estimators/eigen_modes.h"
#include "estimators/process/process_model.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

constexpr double kTimeConstants = 2;
constexpr double kMost = 3;  ///< s; a record is not given up for an arm that hardly comes to rest

/// ∂(q', q'')/∂(q, q') of the joints whose cables stretch, with the motors held.
Eigen::MatrixXd swing_of(const ProcessModel& process, const Eigen::VectorXd& home) {
  const StateLayout& l = process.layout();
  Eigen::MatrixXd A;
  process.derivative({}, process.state_at_rest(unstretched_motors(process.arm(), home), home), &A);
  std::vector<int> states;
  for (const int shift : {0, l.positions})
    for (int k = 0; k < l.n_joints; ++k)
      if (process.arm().joint[k].drive == Drive::cable) states.push_back(l.position[k] + shift);
  return A(states, states);
}

}  // namespace

double settling_time(const ArmModel& model, double least) {
  ArmModel sliding = model;
  sliding.effects.clear();
  for (int k = 0; k < model.n(); ++k) sliding.nominal.joint[k].joint_coulomb = 0;
  double time = least;
  try {
    const Eigen::MatrixXd swing = swing_of(ProcessModel(sliding), model.home());
    if (swing.rows() == 0 || !swing.allFinite()) return least;
    for (const std::complex<double>& mode : eigenvalues(swing)) {
      const bool swings = std::abs(mode.imag()) > std::abs(mode.real());
      if (swings && mode.real() < 0) time = std::max(time, kTimeConstants / -mode.real());
    }
  } catch (const std::runtime_error&) {  // rates that are not finite, which a prediction tells
  }
  return std::clamp(time, least, std::max(least, kMost));
}

}  // namespace halyard
