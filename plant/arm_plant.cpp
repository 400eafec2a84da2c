#include "plant/arm_plant.h"

#include <Eigen/Cholesky>
#include <cstring>

#include "plant/simbody_arm.h"

namespace halyard {
namespace {

using SimTK::Stage;
using SimTK::Vector;

Eigen::VectorXd to_eigen(const Vector& v) { return Eigen::Map<const Eigen::VectorXd>(&v[0], v.size()); }

/// Whether the terms contain q' = v of joint k.
bool moves(DriveTerms terms, int k) { return terms != DriveTerms::first_cable || k == 0; }

}  // namespace

ArmPlant::ArmPlant(const ArmParameters<double>& nominal, const std::vector<PlacedEffect>& effects)
    : arm_(std::make_unique<SimbodyArm>(nominal, effects)) {}

ArmPlant::~ArmPlant() = default;

const DriveTrain& ArmPlant::drive() const { return arm_->drive; }

void ArmPlant::set_inputs(double time_s, const double* command, const double* external) {
  arm_->drive.set_inputs(time_s, command, external);
  arm_->state.invalidateAllCacheAtOrAbove(Stage::Dynamics);
}

void ArmPlant::derivative(double time_s, const double* y, double* y_dot) {
  ++evaluations_;
  arm_->set_state(time_s, y);
  arm_->system.realize(arm_->state, Stage::Acceleration);
  const Vector& rate = arm_->state.getYDot();
  std::memcpy(y_dot, &rate[0], rate.size() * sizeof(double));
}

void ArmPlant::derivative_of_terms(DriveTerms terms, double time_s, const double* y, double* y_dot) {
  const int n = layout().n;
  arm_->set_state(time_s, y);
  arm_->system.realize(arm_->state, Stage::Position);
  arm_->drive.rates(terms, time_s, y, y + n, y + 2 * n, y_dot + n, y_dot + 2 * n);
  for (int k = 0; k < n; ++k) y_dot[k] = moves(terms, k) ? y[n + k] : 0;
  Eigen::Map<Eigen::VectorXd> acceleration(y_dot + n, n);
  arm_->total_mass(arm_->state).llt().solveInPlace(acceleration);
}

void ArmPlant::jacobian_of_terms(DriveTerms terms, double time_s, const double* y, Eigen::Ref<Eigen::MatrixXd> J) {
  const int n = layout().n;
  arm_->set_state(time_s, y);
  arm_->system.realize(arm_->state, Stage::Position);
  Eigen::MatrixXd slopes;
  arm_->drive.slopes(terms, time_s, y, y + n, y + 2 * n, slopes);
  J.topRows(n).setZero();
  for (int k = 0; k < n; ++k)
    if (moves(terms, k)) J(k, n + k) = 1;
  J.middleRows(n, n) = arm_->total_mass(arm_->state).llt().solve(slopes.topRows(n));
  J.bottomRows(layout().n_z) = slopes.bottomRows(layout().n_z);
}

Eigen::MatrixXd ArmPlant::mass_matrix(const Eigen::VectorXd& q) {
  arm_->state.updQ() = Vector(static_cast<int>(q.size()), q.data());
  arm_->system.realize(arm_->state, Stage::Position);
  return arm_->total_mass(arm_->state) - arm_->drive.rotor_mass();
}

Eigen::VectorXd ArmPlant::holding_force(const Eigen::VectorXd& q) {
  arm_->state.updQ() = Vector(static_cast<int>(q.size()), q.data());
  arm_->state.updU() = 0;
  arm_->system.realize(arm_->state, Stage::Velocity);
  Vector force;
  arm_->matter.calcResidualForceIgnoringConstraints(arm_->state, Vector(), arm_->gravity.getBodyForces(arm_->state),
                                                    Vector(), force);
  return to_eigen(force);
}

Eigen::VectorXd ArmPlant::velocity_force(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  arm_->state.updQ() = Vector(static_cast<int>(q.size()), q.data());
  arm_->state.updU() = Vector(static_cast<int>(v.size()), v.data());
  arm_->system.realize(arm_->state, Stage::Velocity);
  Vector force;
  arm_->matter.calcResidualForceIgnoringConstraints(arm_->state, Vector(), SimTK::Vector_<SimTK::SpatialVec>(),
                                                    Vector(), force);
  return to_eigen(force);
}

Eigen::Vector3d ArmPlant::position_of(const double* point, const Eigen::VectorXd& q) {
  arm_->state.updQ() = Vector(static_cast<int>(q.size()), q.data());
  arm_->system.realize(arm_->state, Stage::Position);
  const SimTK::MobilizedBodyIndex last(arm_->matter.getNumBodies() - 1);
  const SimTK::Vec3 at = arm_->matter.getMobilizedBody(last).findStationLocationInGround(
      arm_->state, SimTK::Vec3(point[0], point[1], point[2]));
  return {at[0], at[1], at[2]};
}

double ArmPlant::stored_energy(double time_s, const double* y) {
  const int n = layout().n;
  arm_->set_state(time_s, y);
  arm_->system.realize(arm_->state, Stage::Dynamics);
  return arm_->system.calcEnergy(arm_->state) + arm_->drive.stored_energy(time_s, y, y + n, y + 2 * n);
}

}  // namespace halyard
