#pragma once
/// Records for tests of estimators: of the arm's own process model as the plant, and logs of the second simulator.

#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "estimators/estimator.h"
#include "estimators/process/process_model.h"
#include "estimators/process/static_equilibrium.h"
#include "model/log.h"
#include "model/model_file.h"
#include "transmission/coupling.h"

namespace halyard {

inline ArmModel raven2() { return read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml"); }

/// Adds an effect of the library with these parameters.
inline void add_effect(ArmModel& model, const std::string& name, EffectPlace joint, const std::vector<double>& p) {
  PlacedEffect placed = place_effect(*find_effect(name), model.nominal, joint);
  for (std::size_t i = 0; i < p.size(); ++i) placed.p[i] = p[i];
  model.effects.push_back(placed);
}

/// The first joints of a chain of the RAVEN-II's, one after another: n = 1 to 7. Links further out are lighter, so that
/// the motors carry them. Cables are `stiffer` times as stiff and damped.
inline ArmModel chain_of(int n, double stiffer) {
  ArmModel model = raven2();
  const ArmModel raven = model;
  model.nominal.n = n;
  model.joints.resize(n);
  for (int k = 0; k < n; ++k) {
    JointParameters<double>& j = model.nominal.joint[k];
    j = raven.nominal.joint[k % 3];
    model.joints[k] = raven.joints[k % 3];
    if (k >= 3) std::fill(j.coupling, j.coupling + kMaxJoints, 0.0), j.coupling[k] = 1;
    const double lighter = std::pow(0.3, k / 3);
    j.mass *= lighter;
    for (double& moment : j.inertia) moment *= lighter;
    j.stiffness *= stiffer;
    j.damping *= stiffer;
  }
  return model;
}

/// A state of the RAVEN-II at home with these joint speeds, cables unstretched.
inline Eigen::VectorXd at_speed(const ArmModel& model, const ProcessModel& process, const Eigen::Vector3d& v) {
  const Eigen::VectorXd rate = unstretched_motors(process.arm(), v);
  Eigen::VectorXd x = process.state_at_rest(unstretched_motors(process.arm(), model.home()), model.home());
  for (int k = 0; k < 3; ++k) {
    x(process.layout().rate[k]) = v(k);
    x(*process.layout().motor_rate[k]) = rate(k);
  }
  return x;
}

/// The arm's own process model under PD control on sines around home, 1 kHz, encoders rounded, no noise. Starts in
/// static equilibrium.
class DrivenArm {
 public:
  explicit DrivenArm(const ArmModel& model) : model_(model), process_(model), history_(model.n(), 1) {
    const Eigen::VectorXd home = model.home(), none = Eigen::VectorXd::Zero(model.n());
    const Eigen::VectorXd q_m0 = unstretched_motors(process_.arm(), home);
    x_ = process_.state_at_rest(
        q_m0,
        static_equilibrium(process_, 0, q_m0, none, Eigen::VectorXd::Zero(process_.layout().n_effect_states), home));
  }

  Eigen::VectorXd joint_position() const { return x_(index(process_.layout().position)); }
  Eigen::VectorXd joint_velocity() const { return x_(index(process_.layout().rate)); }

  /// What the motors see now, and a step ahead.
  Sample next() {
    const int n = model_.n();
    Sample s;
    s.time_s = static_cast<double>(tick_++) * 1e-3;
    s.motor_torque.resize(n);
    s.motor_position = process_.motor_readings(s.time_s, x_);
    Eigen::VectorXd q_d = model_.home();
    for (int k = 0; k < n; ++k)
      q_d(k) += (model_.nominal.joint[k].type == JointType::revolute ? 0.2 : 0.02) * std::sin(2.5 * (k + 1) * s.time_s);
    const Eigen::VectorXd wanted = unstretched_motors(process_.arm(), q_d);
    for (int k = 0; k < n; ++k) {
      const ControllerParameters& c = model_.joints[k].controller;
      const double torque = 3 * c.kp * (wanted(k) - s.motor_position(k)) - c.kd * x_(*process_.layout().motor_rate[k]);
      s.motor_torque(k) = std::min(c.torque_limit, std::max(-c.torque_limit, torque));
      const double resolution = model_.nominal.joint[k].motor_encoder_resolution;
      s.motor_position(k) = resolution * std::round(s.motor_position(k) / resolution);
    }
    history_.push(s.time_s, s.motor_torque.data());
    process_.advance({s.time_s, 1e-3, s.motor_torque.data(), nullptr, &history_}, x_.data());
    return s;
  }

 private:
  std::vector<int> index(const int* states) const { return {states, states + model_.n()}; }

  ArmModel model_;
  ProcessModel process_;
  CommandHistory history_;
  Eigen::VectorXd x_;
  long tick_ = 0;
};

/// What the motors see, and where the joints truly are.
struct ArmRun {
  std::vector<Sample> samples;
  std::vector<Eigen::VectorXd> joint_position, joint_velocity;
};

inline ArmRun run_arm(const ArmModel& model, double duration_s) {
  DrivenArm arm(model);
  ArmRun run;
  for (long i = 0; i <= std::lround(duration_s * 1000); ++i) {
    run.joint_position.push_back(arm.joint_position());
    run.joint_velocity.push_back(arm.joint_velocity());
    run.samples.push_back(arm.next());
  }
  return run;
}

/// Joint position errors of an estimator over a run, RMS [n] from `from_s` on.
inline Eigen::VectorXd rms_error(Estimator& estimator, const ArmRun& run, double from_s) {
  estimator.reset(run.samples[0]);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(run.joint_position[0].size());
  long count = 0;
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    estimator.update(run.samples[i]);
    if (run.samples[i].time_s < from_s) continue;
    sum += (estimator.estimate().joint_position - run.joint_position[i]).cwiseAbs2();
    ++count;
  }
  return (sum / count).cwiseSqrt();
}

/// A log of the second simulator as a run; without samples if the shared data are not there.
inline ArmRun rig_run(const std::string& file, int n) {
  const std::filesystem::path path = std::filesystem::path(HALYARD_SHARED_DATA) / "rig" / file;
  ArmRun run;
  if (!std::filesystem::exists(path)) return run;
  const Log log = read_log(path, n);
  for (std::size_t i = 0; i < log.size(); ++i) {
    Sample s;
    s.time_s = log.time[i];
    s.motor_torque.resize(n);
    s.motor_position.resize(n);
    Eigen::VectorXd q(n);
    for (int k = 0; k < n; ++k) {
      s.motor_torque(k) = log.motor_torque[k][i];
      s.motor_position(k) = log.motor_position[k][i];
      q(k) = log.joint_position[k][i];
    }
    run.samples.push_back(s);
    run.joint_position.push_back(q);
  }
  return run;
}

}  // namespace halyard
