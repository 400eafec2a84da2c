#include "plant/simulate.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

#include "model/homing.h"
#include "model/input_error.h"
#include "model/machine/memory_limit.h"
#include "model/output/number_text.h"
#include "model/xml/arm_checks.h"
#include "plant/controller.h"
#include "plant/equilibrium.h"
#include "plant/integrators/integrator.h"
#include "plant/sensors/camera.h"
#include "plant/sensors/encoder.h"
#include "plant/trajectory.h"
#include "transmission/body_inertia.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

constexpr double kProgressPeriod = 0.1;  // s of simulated time

Eigen::VectorXd desired_joints(const Scenario& scenario, double time_s) {
  Eigen::VectorXd q(scenario.robot.n());
  for (int k = 0; k < q.size(); ++k) q(k) = desired_position(scenario.trajectory[k], scenario.fade_in_s, time_s);
  return q;
}

long number_of_ticks(const Scenario& scenario) { return std::lround(scenario.duration_s / scenario.control_period_s); }

bool has_motor(const Scenario& scenario, int k) { return scenario.robot.nominal.joint[k].drive != Drive::none; }

Log empty_log(const Scenario& scenario, long rows, bool with_velocity) {
  const int n = scenario.robot.n();
  Log log(n);
  log.time.resize(rows);
  for (int k = 0; k < n; ++k) {
    if (has_motor(scenario, k)) log.motor_torque[k].resize(rows), log.motor_position[k].resize(rows);
    log.joint_position[k].resize(rows);
    if (with_velocity) log.joint_velocity[k].resize(rows);
  }
  return log;
}

std::vector<ControllerParameters> controller_parameters(const ArmModel& robot) {
  std::vector<ControllerParameters> parameters;
  for (const JointDescription& j : robot.joints) parameters.push_back(j.controller);
  return parameters;
}

/// Both logs of simulate() in memory, and one of them as the text of its file: 8 and, while the text grows, about twice
/// as many bytes a number.
double bytes_of_a_tick(const Scenario& scenario) {
  constexpr double kSignals = 7, kBytes = 24;  // of the truth 4 signals a joint, of the measured log 3
  return kBytes * (2 + kSignals * scenario.robot.n());
}

std::string place(const Scenario& scenario) { return "scenario " + in_quotes(scenario.name) + ": "; }

/// What controller and homing know of the arm.
ArmParameters<double> assumed_arm(const Scenario& scenario) {
  return scenario.assumed ? arm_with_effects(*scenario.assumed) : scenario.robot.nominal;
}

/// The true arm, its motors' zeros as homing leaves them. An `encoder_offset` among the effects is an error of homing.
ArmParameters<double> homed_arm(const Scenario& scenario) {
  ArmParameters<double> arm = scenario.robot.nominal;
  if (!scenario.homed) return arm;
  const Eigen::VectorXd home = scenario.robot.home();
  const ArmParameters<double>& assumed = scenario.assumed ? scenario.assumed->nominal : scenario.robot.nominal;
  const Eigen::VectorXd expected = unstretched_motors(assumed_arm(scenario), home);
  const Eigen::VectorXd there = unstretched_motors(arm_with_effects(scenario.robot), home);
  for (int k = 0; k < arm.n; ++k)
    arm.joint[k].motor_encoder_offset = assumed.joint[k].motor_encoder_offset + expected(k) - there(k);
  return arm;
}

Engine engine_of(const Scenario& scenario) { return scenario.engine.value_or(Engine::simbody); }

std::unique_ptr<ArmPlant> make_plant(const Scenario& scenario) {
  try {
    return std::make_unique<ArmPlant>(homed_arm(scenario), scenario.robot.effects, engine_of(scenario));
  } catch (const std::invalid_argument& error) {
    throw InputError(place(scenario) + error.what());
  }
}

Eigen::VectorXd starting_state(const Scenario& scenario, ArmPlant& plant) {
  try {
    return resting_state(plant, 0, desired_joints(scenario, 0));
  } catch (const InputError& error) {
    throw InputError(place(scenario) + error.what());
  }
}

/// What happens at one instant of control; all [n].
struct Tick {
  JointSignals<double> signals[kMaxJoints];
  Readings readings;
  Eigen::VectorXd commanded_torque;
  Eigen::VectorXd applied_torque;  ///< with the motors' noise
  Eigen::VectorXd load;            ///< on the joints
};

/// Reads the encoders, asks the controller, and draws the noise, always in the same order.
class ControlLoop {
 public:
  explicit ControlLoop(const Scenario& scenario)
      : scenario_(scenario),
        assumed_(assumed_arm(scenario)),
        controller_(controller_parameters(scenario.robot), scenario.control_period_s),
        random_(scenario.seed),
        motor_reading_(noise_of_readings(scenario.noise.motor_reading, &JointParameters<double>::motor_encoder_noise)),
        joint_reading_(noise_of_readings(scenario.noise.joint_reading, &JointParameters<double>::joint_encoder_noise)) {
  }

  Tick tick(double time_s, const DriveTrain& drive, const Eigen::VectorXd& y) {
    const int n = scenario_.robot.n();
    Tick tick;
    for (int k = 0; k < n; ++k) {
      const double rate = y(n + k);
      tick.signals[k].joint_acceleration = (rate - last_rate_[k]) / scenario_.control_period_s;
      last_rate_[k] = rate;
    }
    drive.signals(time_s, y.data(), y.data() + n, y.data() + 2 * n, tick.signals);
    for (std::size_t k = 0; k < motor_reading_.size(); ++k)
      tick.signals[k].motor_error += motor_reading_[k] * normal_(random_);
    for (std::size_t k = 0; k < joint_reading_.size(); ++k)
      tick.signals[k].joint_error += joint_reading_[k] * normal_(random_);
    tick.readings = read_encoders(drive.arm(), tick.signals, scenario_.quantise);
    tick.commanded_torque = controller_.torque(desired_readings(time_s), tick.readings.motor);
    tick.applied_torque = tick.commanded_torque;
    add_noise(scenario_.noise.motor_torque, tick.applied_torque);
    tick.load = Eigen::VectorXd::Zero(n);
    add_noise(scenario_.noise.joint_force, tick.load);
    return tick;
  }

 private:
  /// What the motors' encoders would read at the desired positions if the arm were as the controller assumes.
  Eigen::VectorXd desired_readings(double time_s) const {
    Eigen::VectorXd readings = unstretched_motors(assumed_, desired_joints(scenario_, time_s));
    for (int k = 0; k < assumed_.n; ++k)
      if (assumed_.joint[k].drive != Drive::none) readings(k) += assumed_.joint[k].motor_encoder_offset;
    return readings;
  }

  /// Of the scenario and of the robot's own encoders together; empty: none.
  std::vector<double> noise_of_readings(std::vector<double> deviation, double JointParameters<double>::*own) const {
    const ArmParameters<double>& arm = scenario_.robot.nominal;
    for (int k = 0; k < arm.n; ++k) {
      if (arm.joint[k].*own == 0) continue;
      deviation.resize(arm.n);
      deviation[k] = std::hypot(deviation[k], arm.joint[k].*own);
    }
    return deviation;
  }

  void add_noise(const std::vector<double>& deviation, Eigen::VectorXd& to) {
    for (std::size_t k = 0; k < deviation.size(); ++k) to[k] += deviation[k] * normal_(random_);
  }

  const Scenario& scenario_;
  const ArmParameters<double> assumed_;
  PdController controller_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_{0, 1};
  std::vector<double> motor_reading_, joint_reading_;  ///< standard deviations
  double last_rate_[kMaxJoints] = {};                  ///< of the joints, which start at rest
};

/// Writes a tick into row i of both logs.
void record(const Scenario& scenario, const Tick& tick, double time_s, long i, SimulationResult& result) {
  result.measured.time[i] = result.truth.time[i] = time_s;
  for (int k = 0; k < scenario.robot.n(); ++k) {
    const JointSignals<double>& s = tick.signals[k];
    if (has_motor(scenario, k)) {
      result.measured.motor_torque[k][i] = tick.commanded_torque(k);
      result.measured.motor_position[k][i] = tick.readings.motor(k);
      result.truth.motor_torque[k][i] = tick.applied_torque(k);
      result.truth.motor_position[k][i] = s.motor_angle;
    }
    result.measured.joint_position[k][i] = tick.readings.joint(k);
    result.truth.joint_position[k][i] = s.joint_position;
    result.truth.joint_velocity[k][i] = s.joint_rate;
  }
}

/// No motor turns so fast, rad/s.
constexpr double kFastestMotor = 1e5;

void refuse_runaway(const Scenario& scenario, const Tick& tick, double time_s) {
  for (int k = 0; k < scenario.robot.n(); ++k)
    if (has_motor(scenario, k) && !(std::abs(tick.signals[k].motor_rate) < kFastestMotor))
      throw InputError(place(scenario) + "motor " + std::to_string(k + 1) + " turns faster than " +
                       std::to_string(std::lround(kFastestMotor)) + " rad/s at " + with_decimals(time_s, 6) +
                       " s, so the controlled arm is unstable; lower kp and kd of the joint's "
                       "<controller>, or state its torque_limit");
}

/// What an integrator does, a failure with the scenario's place.
template <class Action>
auto with_place(const Scenario& scenario, const Action& action) {
  try {
    return action();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(place(scenario) + error.what());
  }
}

/// From the start at time 0 to the end.
EnergyBalance energy_balance(ArmPlant& plant, const Eigen::VectorXd& start, const Eigen::VectorXd& end,
                             double end_time_s) {
  const PlantLayout& l = plant.layout();
  return {.input = end(2 * l.n + l.input_energy),
          .dissipated = end(2 * l.n + l.lost_energy),
          .stored = plant.stored_energy(end_time_s, end.data()) - plant.stored_energy(0, start.data())};
}

void check_integrator(const Scenario& scenario) {
  const IntegratorOptions& options = scenario.integrator;
  // Finer ones ask for more than the 16 digits of a number; from 1 on a step may be all error.
  constexpr double kLeastRelative = 1e-14, kLeastAbsolute = 1e-15;
  if (!(options.relative_tolerance >= kLeastRelative && options.relative_tolerance < 1))
    throw InputError(place(scenario) + "the integrator's relative tolerance must be from 1e-14 to below 1");
  if (!(options.absolute_tolerance >= kLeastAbsolute) || !std::isfinite(options.absolute_tolerance))
    throw InputError(place(scenario) + "the integrator's absolute tolerance must be at least 1e-15");
  if (is_of_simbody(options.kind) && engine_of(scenario) != Engine::simbody)
    throw InputError(place(scenario) + "an integrator of Simbody's needs engine=\"simbody\" of the scenario");
}

void check_noise(const Scenario& scenario) {
  constexpr double kMostNoise = 1e6;  // beyond any sensor and motor in SI units, and far from the largest numbers
  const TickNoise& noise = scenario.noise;
  const std::pair<const char*, const std::vector<double>*> all[] = {{"torque noise", &noise.motor_torque},
                                                                    {"joint force noise", &noise.joint_force},
                                                                    {"motor position noise", &noise.motor_reading},
                                                                    {"joint position noise", &noise.joint_reading}};
  for (const auto& [name, deviations] : all)
    for (const double deviation : *deviations)
      if (!(deviation >= 0 && deviation <= kMostNoise))
        throw InputError(place(scenario) + "the " + name + " must be from 0 to 1e6 in SI units");
  for (const JointParameters<double>& j : scenario.robot.nominal.joint)
    if (!(j.motor_encoder_noise <= kMostNoise && j.joint_encoder_noise <= kMostNoise))
      throw InputError(place(scenario) + "the noise of the robot's encoders must be from 0 to 1e6 in SI units");
}

/// Effects that are each within their bounds may leave an inertia that no body has.
void check_changed_inertia(const Scenario& scenario) {
  const auto impossible_link = [](const ArmParameters<double>& before, const ArmParameters<double>& after) {
    for (int k = 0; k < after.n; ++k)
      if (find_inertia_fault(principal_moments(after.joint[k])) != InertiaFault::none &&
          find_inertia_fault(principal_moments(before.joint[k])) == InertiaFault::none)
        return "link " + std::to_string(k + 1);
    return std::string();
  };
  const std::vector<PlacedEffect>& effects = scenario.robot.effects;
  if (const auto fault = first_fault(scenario.robot.nominal, effects, impossible_link))
    throw InputError(place(scenario) + "with " + effect_label(effects[fault->effect]) + " the inertia of " +
                     fault->what + " is that of no body; make the change smaller, or remove the effect");
}

}  // namespace

Scenario faster(Scenario scenario) {
  if (!scenario.engine && !is_of_simbody(scenario.integrator.kind)) scenario.engine = Engine::halyard;
  return scenario;
}

void check_memory_of_run(const Scenario& scenario) {
  check_memory(scenario.duration_s / scenario.control_period_s * bytes_of_a_tick(scenario), place(scenario) + "the run",
               "take a shorter duration or a longer control period");
}

void check_scenario(const Scenario& scenario) {
  const std::string where = place(scenario);
  const int n = scenario.robot.n();
  if (!(scenario.duration_s > 0) || !(scenario.control_period_s > 0) ||
      !(scenario.duration_s >= scenario.control_period_s))
    throw InputError(where + "the duration must be at least one control period, and both above 0 s");
  constexpr double kShortestPeriod = 1e-6;
  if (scenario.control_period_s < kShortestPeriod)
    throw InputError(where + "the control period must be at least 1e-6 s: logs give times to a microsecond");
  check_memory_of_run(scenario);
  check_integrator(scenario);
  check_noise(scenario);
  if (static_cast<int>(scenario.trajectory.size()) != n || static_cast<int>(scenario.robot.joints.size()) != n)
    throw InputError(where + "there must be one trajectory for each of the " + std::to_string(n) + " joints");
  for (int k = 0; k < n; ++k) {
    const std::string joint = where + "trajectory of joint " + std::to_string(k + 1) + ": ";
    try {
      check_trajectory(scenario.trajectory[k]);
    } catch (const InputError& error) {
      throw InputError(joint + error.what());
    }
    const ControllerParameters& controller = scenario.robot.joints[k].controller;
    const bool is_driven = controller.acts() || !has_motor(scenario, k);
    if (scenario.trajectory[k].kind != JointTrajectory::Kind::hold && !is_driven)
      throw InputError(joint +
                       "the joint has no controller that follows it; give the model's joint a <controller> with "
                       "kp and kd");
    const JointDescription& range = scenario.robot.joints[k];
    if (!(range.lower < range.upper)) continue;
    const std::string unit = scenario.robot.nominal.joint[k].type == JointType::revolute ? " rad" : " m";
    // At each tick; of a long run at every few, so that the check stays short.
    constexpr long kMostInstants = 20'000;
    const long ticks = number_of_ticks(scenario), stride = ticks / kMostInstants + 1;
    for (long i = 0; i <= ticks; i += stride) {
      const double t = i * scenario.control_period_s;
      const double q = desired_position(scenario.trajectory[k], scenario.fade_in_s, t);
      if (!(q >= range.lower && q <= range.upper))
        throw InputError(joint + "asks for " + with_decimals(q, 6) + unit + " at " + with_decimals(t, 6) +
                         " s, outside the joint's range " + with_decimals(range.lower, 6) + " to " +
                         with_decimals(range.upper, 6) + unit + "; make it smaller or move its center");
    }
  }
  check_changed_inertia(scenario);
  make_plant(scenario);  // which refuses what it cannot compute
}

SimulationResult simulate(const Scenario& scenario, const std::function<void(double)>& progress) {
  check_scenario(scenario);
  const double period = scenario.control_period_s;
  const long ticks = number_of_ticks(scenario);
  const long ticks_per_report = std::max(1L, std::lround(kProgressPeriod / period));

  const std::unique_ptr<ArmPlant> plant = make_plant(scenario);
  const Eigen::VectorXd start = starting_state(scenario, *plant);
  const std::unique_ptr<Integrator> integrator =
      with_place(scenario, [&] { return make_integrator(*plant, scenario.integrator, 0, start); });
  ControlLoop loop(scenario);
  SimulationResult result{.measured = empty_log(scenario, ticks + 1, /*with_velocity=*/false),
                          .truth = empty_log(scenario, ticks + 1, /*with_velocity=*/true),
                          .energy = {}};
  for (long i = 0; i <= ticks; ++i) {
    const double t = i * period;
    const Tick tick = loop.tick(t, plant->drive(), integrator->state());
    refuse_runaway(scenario, tick, t);
    record(scenario, tick, t, i, result);
    if (progress && i % ticks_per_report == 0) progress(static_cast<double>(i) / ticks);
    if (i == ticks) break;
    plant->set_inputs(t, tick.applied_torque.data(), tick.load.data());
    with_place(scenario, [&] { integrator->advance((i + 1) * period); });
  }

  if (scenario.camera)
    add_camera(*scenario.camera, scenario.robot.nominal.payload_point, result.truth, scenario.seed, *plant,
               result.measured);
  result.energy = energy_balance(*plant, start, integrator->state(), ticks * period);
  result.derivative_evaluations = plant->derivative_evaluations();
  return result;
}

SimulationResult simulate_homed(const Scenario& scenario, const ArmModel& model,
                                const std::function<void(double)>& progress) {
  SimulationResult result = simulate(scenario, progress);
  home_encoders(result.measured, model);
  return result;
}

}  // namespace halyard
