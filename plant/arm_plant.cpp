#include "plant/arm_plant.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <stdexcept>
#include <string>

#include "plant/rigid_arm.h"
#include "transmission/body_inertia.h"

namespace halyard {
namespace {

void check_finite(const double* x, int size) {
  if (!Eigen::Map<const Eigen::VectorXd>(x, size).allFinite())
    throw std::runtime_error("a rate of the arm's state is not finite");
}

void check_inertias(const ArmParameters<double>& arm) {
  for (int k = 0; k < arm.n; ++k)
    if (find_inertia_fault(principal_moments(arm.joint[k])) != InertiaFault::none)
      throw std::invalid_argument("link " + std::to_string(k + 1) +
                                  ": no body has this inertia: each principal moment must be at least 0, and at most "
                                  "the sum of the others");
}

std::unique_ptr<RigidArm> make_chain(const DriveTrain& drive, Engine engine) {
  check_inertias(drive.arm());
  return engine == Engine::simbody ? make_simbody_arm(drive) : make_newton_euler_arm(drive);
}

/// Whether the terms contain q' = v of joint k.
bool moves(DriveTerms terms, int k) { return terms != DriveTerms::first_cable || k == 0; }

}  // namespace

ArmPlant::ArmPlant(const ArmParameters<double>& nominal, const std::vector<PlacedEffect>& effects, Engine engine)
    : drive_(nominal, effects), engine_(engine), chain_(make_chain(drive_, engine)) {}

ArmPlant::~ArmPlant() = default;

void ArmPlant::set_inputs(double time_s, const double* command, const double* external) {
  drive_.set_inputs(time_s, command, external);
}

void ArmPlant::derivative(double time_s, const double* y, double* y_dot) {
  ++evaluations_;
  chain_->derivative(time_s, y, y_dot);
  check_finite(y_dot, layout().size());
}

void ArmPlant::jacobian(double time_s, const double* y, double* y_dot, Eigen::Ref<Eigen::MatrixXd> J) {
  ++evaluations_;
  const int n = layout().n, stride = static_cast<int>(J.outerStride());
  drive_.linearise(DriveTerms::all, time_s, y, y_dot, J);
  plant_kernels().front().accelerate_with_slopes(drive_.arm(), y, y + n, y_dot + n, J.data() + n, stride,
                                                 layout().size());
  J.topRows(n).setZero();
  J.block(0, n, n, n).setIdentity();
  if (engine_ == Engine::simbody) chain_->derivative(time_s, y, y_dot);
  else std::copy_n(y + n, n, y_dot);
  check_finite(y_dot, layout().size());
}

void ArmPlant::derivative_of_terms(DriveTerms terms, double time_s, const double* y, double* y_dot) {
  const int n = layout().n;
  drive_.rates(terms, time_s, y, y + n, y + 2 * n, y_dot + n, y_dot + 2 * n);
  for (int k = 0; k < n; ++k) y_dot[k] = moves(terms, k) ? y[n + k] : 0;
  Eigen::Map<Eigen::VectorXd> acceleration(y_dot + n, n);
  chain_->total_mass(time_s, y).llt().solveInPlace(acceleration);
}

void ArmPlant::jacobian_of_terms(DriveTerms terms, double time_s, const double* y, Eigen::Ref<Eigen::MatrixXd> J) {
  const int n = layout().n;
  Eigen::MatrixXd slopes;
  drive_.slopes(terms, time_s, y, y + n, y + 2 * n, slopes);
  J.topRows(n).setZero();
  for (int k = 0; k < n; ++k)
    if (moves(terms, k)) J(k, n + k) = 1;
  J.middleRows(n, n) = chain_->total_mass(time_s, y).llt().solve(slopes.topRows(n));
  J.bottomRows(layout().n_z) = slopes.bottomRows(layout().n_z);
}

Eigen::MatrixXd ArmPlant::mass_matrix(const Eigen::VectorXd& q) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(layout().size());
  y.head(layout().n) = q;
  return chain_->total_mass(0, y.data()) - drive_.rotor_mass();
}

Eigen::VectorXd ArmPlant::holding_force(const Eigen::VectorXd& q) { return chain_->holding_force(q); }

Eigen::VectorXd ArmPlant::velocity_force(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  return chain_->velocity_force(q, v);
}

Eigen::Vector3d ArmPlant::position_of(const double* point, const Eigen::VectorXd& q) {
  return chain_->position_of(point, q);
}

double ArmPlant::stored_energy(double time_s, const double* y) {
  const int n = layout().n;
  return chain_->energy(time_s, y) + drive_.stored_energy(time_s, y, y + n, y + 2 * n);
}

}  // namespace halyard
