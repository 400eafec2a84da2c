#include "estimators/identification/arm_family.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "transmission/jacobian.h"

namespace halyard {

ArmNumber find_number(ArmParameters<double>& arm, const std::string& key) {
  for (const ParameterInfo& info : named_parameters(arm))
    if (info.key == key) return info.number;
  for (int k = 0; k < arm.n; ++k)
    if (key == "joint" + std::to_string(k + 1) + ".motor.zero") return ArmNumber(arm.joint[k].motor_encoder_offset);
  throw std::invalid_argument("the arm has no number " + key);
}

ArmFamily::ArmFamily(const ArmModel& model, const ProcessModel& structure, const std::vector<std::string>& keys,
                     int members)
    : structure_(structure) {
  for (int i = 0; i < members; ++i) {
    arms_.push_back(model.nominal);
    value_.emplace_back();
    for (const std::string& key : keys) value_.back().push_back(find_number(arms_.back(), key));
  }
}

void ArmFamily::set(const Eigen::MatrixXd& theta) {
  for (int i = 0; i < members(); ++i)
    for (std::size_t p = 0; p < value_[i].size(); ++p) value_[i][p].set(theta(static_cast<Eigen::Index>(p), i));
  lanes_.clear();
  for (int first = 0; first < members(); first += kLaneWidth) {
    ArmParameters<double> eight[kLaneWidth];
    for (int lane = 0; lane < kLaneWidth; ++lane) eight[lane] = arms_[std::min(first + lane, members() - 1)];
    lanes_.emplace_back(pack(eight), structure_.lane_transmission().effects());
  }
}

void ArmFamily::advance(const Step& step, int substeps, Eigen::Ref<Eigen::MatrixXd> X) const {
  const int n = structure_.n_joints(), states = structure_.n_states(), count = static_cast<int>(X.cols());
  const LaneKernels& kernels = lane_kernels()[0];
  Lanes command[kMaxJoints], external[kMaxJoints];
  for (int k = 0; k < n; ++k) {
    command[k] = Lanes(step.motor_torque ? step.motor_torque[k] : 0.0);
    external[k] = Lanes(step.external_force ? step.external_force[k] : 0.0);
  }
  for (int first = 0; first < count; first += kLaneWidth) {
    Lanes x[kMaxStates];
    load_lanes(X, first, x);
    kernels.advance(lanes_[members() == 1 ? 0 : first / kLaneWidth], structure_.layout(), step.time_s, step.dt_s,
                    substeps, step.history, command, external, x);
    for (int i = 0; i < states; ++i)
      for (int lane = 0; lane < kLaneWidth && first + lane < count; ++lane) {
        X(i, first + lane) = x[i][lane];
        if (!std::isfinite(x[i][lane])) structure_.throw_not_finite(step.time_s + step.dt_s, i);
      }
  }
}

Eigen::MatrixXd ArmFamily::readings(double time_s, const Eigen::MatrixXd& X, const LaggedRates& lagged) const {
  const int n = structure_.n_joints(), count = static_cast<int>(X.cols());
  Eigen::MatrixXd all(2 * n, count);
  for (int first = 0; first < count; first += kLaneWidth) {
    Lanes x[kMaxStates], z[2 * kMaxJoints];
    load_lanes(X, first, x);
    read_encoders(lanes_[members() == 1 ? 0 : first / kLaneWidth], structure_.layout(), time_s, x, z, z + n, lagged);
    for (int i = 0; i < 2 * n; ++i)
      for (int lane = 0; lane < kLaneWidth && first + lane < count; ++lane) all(i, first + lane) = z[i][lane];
  }
  return all;
}

Eigen::VectorXd ArmFamily::readings(double time_s, const Eigen::VectorXd& x, Eigen::MatrixXd& H,
                                    const LaggedRates& lagged) const {
  const int n = structure_.n_joints();
  const Transmission<Dual> transmission(lift<Dual>(arms_[0]), structure_.dual_transmission().effects());
  Eigen::VectorXd z(2 * n);
  H.resize(2 * n, structure_.n_states());
  const auto read = [&](const Dual* at, Dual* reading) {
    read_encoders(transmission, structure_.layout(), time_s, at, reading, reading + n, lagged);
  };
  jacobian(read, x, z, H);
  return z;
}

}  // namespace halyard
