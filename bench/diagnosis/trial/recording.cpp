#include "bench/diagnosis/trial/recording.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bench/diagnosis/draw/arms.h"
#include "bench/diagnosis/draw/motion.h"
#include "bench/diagnosis/forms/unregistered.h"
#include "diagnosis/plan.h"
#include "plant/simulate.h"
#include "transmission/effects/typical_size.h"

namespace halyard::blind {
namespace {

constexpr double kFadeIn = 2, kTraining = 30, kHoldOut = 10;  // s

/// The controllers of all runs of a trial.
void scatter_gains(ArmModel& robot, Random& random) {
  for (JointDescription& j : robot.joints) {
    // Above the model's own, so that the motion is followed.
    j.controller.kp *= 2.5 * random.log_uniform(0.7, 1.4);
    j.controller.kd *= 2 * random.log_uniform(0.7, 1.4);
  }
}

/// A run of an arm as the model describes it; the robot is put in later.
Scenario random_run(const ArmModel& model, double length_s, Random& random) {
  Scenario s;
  s.assumed = model;
  s.name = "blind trial";
  s.duration_s = kFadeIn + length_s;
  s.fade_in_s = kFadeIn;
  s.trajectory = random_motion(model, random);
  s.seed = random.seed();
  return s;
}

std::vector<double> draw_disturbance(const ArmModel& model, Random& random) {
  const double share = random.uniform(0, 0.05);
  std::vector<double> deviation;
  for (int k = 0; k < model.n(); ++k) deviation.push_back(share * typical_motor_friction(model.nominal.joint[k]));
  return deviation;
}

void check_that_it_followed(const ArmModel& robot, const Log& truth) {
  for (int k = 0; k < robot.n(); ++k) {
    const JointDescription& j = robot.joints[k];
    const double beyond = 0.2 * (j.upper - j.lower);
    for (const double q : truth.joint_position[k])
      if (!(q > j.lower - beyond && q < j.upper + beyond))
        throw std::runtime_error("joint " + std::to_string(k + 1) + " left its range: the controller lost the arm");
  }
}

/// The log of a run without its fading in, as each of these sensors reads it.
std::vector<Log> record(Scenario scenario, const ArmModel& robot, const std::vector<SensorDraw>& sensors,
                        Random& random) {
  scenario.robot = robot;
  // The sensors here add noise before they round.
  for (int k = 0; k < robot.n(); ++k) {
    JointParameters<double>& j = scenario.robot.nominal.joint[k];
    j.joint_encoder_resolution = j.joint_encoder_noise = 0;
  }
  const SimulationResult run = simulate(faster(scenario));
  check_that_it_followed(robot, run.truth);
  const auto first = static_cast<std::size_t>(std::lround(kFadeIn / scenario.control_period_s));
  std::vector<Log> logs;
  for (const SensorDraw& s : sensors) {
    const Log log = read_sensors(s, run.measured, robot, random);
    logs.push_back(slice(log, first, log.size()));
  }
  return logs;
}

MotionRange range_of(const Scenario& training) {
  const double from = kFadeIn, to = training.duration_s;
  MotionRange range{{from, to}, {}, {}};
  for (const JointTrajectory& t : training.trajectory) {
    const Travel travel = travel_of(t, kFadeIn, from, to);
    range.joint.push_back({travel.least, travel.most});
    range.fastest.push_back(travel.fastest);
  }
  return range;
}

std::vector<double> seen_from(const ArmModel& model, const Log& probe, const std::vector<Hidden>& hidden) {
  std::vector<PlacedEffect> effects;
  for (const Hidden& h : hidden) {
    const auto* other = dynamic_cast<const PlannedAs*>(h.acts.effect);
    effects.push_back(other ? other->planned_as(h.acts, model.nominal) : h.acts);
  }
  std::vector<double> shares = detected_from(model, {probe}, effects);
  for (std::size_t i = 0; i < hidden.size(); ++i)
    if (const auto* above = dynamic_cast<const AboveBand*>(hidden[i].acts.effect))
      shares[i] = 1 / above->encoder_counts(model.nominal, effects[i].joint.value_or(0), effects[i].p);
  return shares;
}

}  // namespace

Recording draw_recording(const ArmModel& raven2, const Situation& situation, int index, const TrialOptions& options,
                         Random& random) {
  Recording r;
  r.model = draw_arm(situation.arms, raven2, random);
  r.hidden = draw_effects(r.model, situation.kind, index, random);
  ArmModel controlled = r.model;
  scatter_gains(controlled, random);

  Scenario training = random_run(r.model, kTraining, random), holdout = random_run(r.model, kHoldOut, random);
  training.noise.motor_torque = holdout.noise.motor_torque = draw_disturbance(r.model, random);
  const MotionRange range = range_of(training);
  for (Hidden& h : r.hidden) draw_parameters(h.acts, r.model, range, random);
  r.sensors = draw_sensors(situation.sensors, r.model, range.record.from, range.record.to, random);
  r.sensors.outlier_share = options.outliers;
  // Sensors that are late by nature would hide one that is late by an effect.
  if (std::ranges::any_of(r.hidden, [](const Hidden& h) { return h.right_name == "delay"; })) r.sensors.latency_s = 0;

  r.robot = controlled;
  mistune(r.robot, situation.off, r.hidden, random);
  for (const Hidden& h : r.hidden) r.robot.effects.push_back(h.acts);
  r.training = record(training, r.robot, {r.sensors}, random)[0];
  r.training.source = "training";
  const std::vector<Log> holdouts = record(holdout, r.robot, {ideal_sensors(r.model), r.sensors}, random);
  r.holdout = holdouts[0];
  r.sensed_holdout = holdouts[1];
  r.holdout.source = r.sensed_holdout.source = "hold-out";
  if (!r.hidden.empty()) {
    const Log probe = record(training, controlled, {r.sensors}, random)[0];
    r.seen_from = seen_from(r.model, probe, r.hidden);
    if (situation.kind == Kind::effect && r.seen_from[0] <= 1)
      r.named_from = named_from(r.model, {probe}, r.hidden[0].acts);
  }
  return r;
}

}  // namespace halyard::blind
