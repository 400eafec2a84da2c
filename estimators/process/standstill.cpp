#include "estimators/process/standstill.h"

#include <cmath>

#include "model/rigid_chain.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

/// Force of cable k at rest, as the capstan feels it.
double cable_force_at(const Transmission<double>& transmission, const StandstillPose& at, int k) {
  JointSignals<double> s[kMaxJoints];
  for (int i = 0; i < transmission.arm().n; ++i) {
    s[i].motor_angle = at.motor_angle(i);
    s[i].joint_position = at.joint_position(i);
  }
  const std::vector<double> z(transmission.n_states() + 1, 0.0);
  std::vector<double> z_dot(z.size());
  transmission.evaluate(0, nullptr, z.data(), s, z_dot.data());
  return s[k].cable_force_motor;
}

/// Turns motor k until its cable carries `force` (signed): the force grows with the motor's angle, with gaps and
/// slack as effects have it. The first digits will do.
void load_cable(const Transmission<double>& transmission, int k, double force, StandstillPose& at) {
  const double travel = transmission.arm().joint[k].motor_travel(), start = at.motor_angle(k);
  const double way = force < 0 ? -1 : 1;
  const auto carries = [&](double stretch) {
    at.motor_angle(k) = start + way * stretch / travel;
    return way * cable_force_at(transmission, at, k) >= std::abs(force);
  };
  double high = 1e-7;  // m
  while (high < 1 && !carries(high)) high *= 2;
  for (double low = high / 2; high - low > 1e-3 * high;) {
    const double middle = 0.5 * (low + high);
    (carries(middle) ? high : low) = middle;
  }
  at.motor_angle(k) = start + way * high / travel;
}

}  // namespace

std::vector<Eigen::VectorXd> range_poses(const ArmModel& model) {
  const Eigen::VectorXd home = model.home();
  std::vector<Eigen::VectorXd> all = {home};
  Eigen::VectorXd lower = home, upper = home;
  for (int k = 0; k < model.n(); ++k) {
    if (!(model.joints[k].lower < model.joints[k].upper)) continue;  // no range given
    for (const double end : {model.joints[k].lower, model.joints[k].upper}) {
      all.push_back(home);
      all.back()(k) = end;
    }
    lower(k) = model.joints[k].lower;
    upper(k) = model.joints[k].upper;
  }
  all.push_back(lower);
  all.push_back(upper);
  return all;
}

Eigen::VectorXd gravity_force(const ArmParameters<double>& arm, const Eigen::VectorXd& q) {
  const double zero[kMaxJoints] = {};
  Eigen::VectorXd force(arm.n);
  inverse_dynamics(arm, chain_pose(arm, q.data()), zero, zero, force.data());
  return force;
}

Eigen::VectorXd largest_gravity_force(const ArmParameters<double>& arm, const ArmModel& model) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(arm.n);
  for (const Eigen::VectorXd& q : range_poses(model)) largest = largest.cwiseMax(gravity_force(arm, q).cwiseAbs());
  return largest;
}

std::vector<StandstillPose> standstill_poses(const Transmission<double>& transmission, const ArmModel& model) {
  const ArmParameters<double>& arm = transmission.arm();
  std::vector<StandstillPose> all;
  for (const Eigen::VectorXd& q : range_poses(model)) {
    const StandstillPose unloaded{unstretched_motors(arm, q), q};
    all.push_back(unloaded);
    const Eigen::VectorXd gravity = gravity_force(arm, q);
    for (const double way : {1.0, -1.0}) {
      all.push_back(unloaded);
      for (int k = 0; k < arm.n; ++k) {
        const JointParameters<double>& j = arm.joint[k];
        if (j.drive != Drive::cable) continue;
        const double limit = model.joints[k].controller.torque_limit;
        const double force = limit > 0 ? limit / j.motor_travel() : j.tension + std::abs(gravity(k)) / j.pulley_radius;
        if (force > 0) load_cable(transmission, k, way * force, all.back());
      }
    }
  }
  return all;
}

}  // namespace halyard
