#pragma once
/// A linear arm, on which filters are exact: a slide on an elastic cable, without Coulomb friction or gravity.

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "estimators/identification/dual_ukf.h"
#include "model/model_file.h"
#include "tests/estimators/process/held_force.h"

namespace halyard {

inline constexpr double kSlideStep = 2e-3;  // s

inline ArmModel slide() {
  constexpr const char* kText = R"(<arm name="slide">
<gravity>0 0 0</gravity>
<joint name="slide" type="prismatic" drive="cable">
<frame xyz="0 0 0" rpy="0 0 0"/>
<link mass="4" com="0 0 0" inertia="1e-3 1e-3 1e-3 0 0 0"/>
<motor inertia="2e-5" coulomb="0" viscous="1e-4" smoothing="0.4" gear_ratio="12" capstan_radius="5.5 mm"/>
<cable law="linear" stiffness="2e4" damping="60" tension="1e4" pulley_radius="1"/>
<friction coulomb="0" viscous="2" smoothing="0.01"/>
<encoders motor_counts="4000" joint_resolution="0.1 mm"/>
<controller kp="0" kd="0" torque_limit="1"/>
<range lower="-0.5" upper="0.5" home="0"/>
</joint>
<estimator name="sr_ukf" torque_noise="0.02" joint_force_noise="5"/>
</arm>)";
  return parse_model(kText, "slide.xml");
}

inline NoiseLevels noise_of_slide(const ArmModel& model, const ProcessModel& process) {
  return levels_of(model, process, model.estimators.at("sr_ukf"));
}

/// Standard deviations of what motor and joint encoder read.
inline Eigen::Vector2d encoder_noise_of_slide(const ArmModel& model) {
  const JointParameters<double>& j = model.nominal.joint[0];
  return Eigen::Vector2d(j.motor_encoder_resolution, j.joint_encoder_resolution) / std::sqrt(12.0);
}

/// Torques of a record: a sine, with an amplitude in N m, and what is added without being told.
struct SlideMotion {
  double amplitude = 0.05, untold_per_s = 0;
  double step_s = kSlideStep;
};

/// A record of the slide, as noisy as its filter takes it to be. It starts at rest, where its belief starts.
inline std::vector<EncoderSample> record_of_slide(const ArmModel& robot, int samples, unsigned seed,
                                                  const SlideMotion& motion = {}) {
  const ProcessModel process(robot);
  ArmNoise noise(robot, process, noise_of_slide(robot, process));
  const Eigen::Vector2d sigma = encoder_noise_of_slide(robot);
  const StateLayout& l = process.layout();
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd x = process.state_at_rest(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1));
  std::vector<EncoderSample> record;
  for (int i = 0; i < samples; ++i) {
    EncoderSample s;
    s.time_s = motion.step_s * i;
    const double command = motion.amplitude * std::sin(2 * std::numbers::pi * 3 * s.time_s);
    s.motor_torque = Eigen::VectorXd::Constant(1, command);
    s.motor_position = Eigen::VectorXd::Constant(1, x(*l.motor_angle[0]) + sigma(0) * normal(random));
    s.joint_position = Eigen::VectorXd::Constant(1, x(l.position[0]) + sigma(1) * normal(random));
    record.push_back(s);
    const double torque = command + motion.untold_per_s * s.time_s;
    const Step step{.time_s = s.time_s, .dt_s = motion.step_s, .motor_torque = &torque};
    const Eigen::MatrixXd Q_root = noise.process_root(step, x);
    process.advance(step, x.data());
    for (Eigen::Index c = 0; c < Q_root.cols(); ++c) x += Q_root.col(c) * normal(random);
  }
  return record;
}

}  // namespace halyard
