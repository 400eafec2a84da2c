#pragma once
/// The simulated RAVEN-II as hardware that a live loop talks to: encoders to read, torques to command, and time that
/// passes between two ticks. The arm follows the sines of arm_example.h under PD control.

#include "arm_example.h"
#include "plant/controller.h"
#include "plant/equilibrium.h"
#include "plant/integrators/integrator.h"
#include "plant/sensors/encoder.h"
#include "plant/trajectory.h"
#include "transmission/coupling.h"

namespace halyard {

class LiveArm {
 public:
  LiveArm(const ArmModel& arm, double period_s)
      : arm_(arm),
        scenario_(on_sines(arm, period_s)),
        plant_(arm.nominal, arm.effects, Engine::halyard),
        controller_(controllers(arm), period_s),
        integrator_(make_integrator(plant_, {.kind = IntegratorKind::rosenbrock}, 0,
                                    resting_state(plant_, 0, desired_joints(0)))),
        load_(Eigen::VectorXd::Zero(arm.n())) {}

  /// What the motor encoders read now, and the torque that the controller answers with, held until the next tick.
  Sample tick(double time_s) {
    JointSignals<double> signals[kMaxJoints];
    const int n = arm_.n();
    const double* y = integrator_->state().data();
    plant_.drive().signals(time_s, y, y + n, y + 2 * n, signals);
    Sample s;
    s.time_s = time_s;
    s.motor_position = read_encoders(plant_.drive().arm(), signals, true).motor;
    s.motor_torque = controller_.torque(unstretched_motors(arm_.nominal, desired_joints(time_s)), s.motor_position);
    plant_.set_inputs(time_s, s.motor_torque.data(), load_.data());
    return s;
  }
  void advance(double until_s) { integrator_->advance(until_s); }
  /// The true joint positions [n], rad | m.
  Eigen::VectorXd joint_position() const { return integrator_->state().head(arm_.n()); }

 private:
  Eigen::VectorXd desired_joints(double time_s) const {
    Eigen::VectorXd q(arm_.n());
    for (int k = 0; k < arm_.n(); ++k) q(k) = desired_position(scenario_.trajectory[k], scenario_.fade_in_s, time_s);
    return q;
  }
  static std::vector<ControllerParameters> controllers(const ArmModel& arm) {
    std::vector<ControllerParameters> all;
    for (const JointDescription& joint : arm.joints) all.push_back(joint.controller);
    return all;
  }

  ArmModel arm_;
  Scenario scenario_;
  ArmPlant plant_;
  PdController controller_;
  std::unique_ptr<Integrator> integrator_;
  Eigen::VectorXd load_;
};

}  // namespace halyard
