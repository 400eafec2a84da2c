#pragma once
/// A scenario: a robot, its true effects, what it is asked to do, and how that is computed. The struct has the
/// defaults; a scenario file mirrors it.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

/// How the plant is integrated; docs/architecture.md says what each is for.
enum class IntegratorKind {
  dirk,            ///< ARKODE, diagonally implicit third order: all implicit (default)
  imex,            ///< ARKODE, fourth order: cables and friction implicit, the rest explicit
  imex_link1,      ///< ARKODE, fourth order: the first link's cable alone implicit
  bdf,             ///< CVODE at 1e-5 of the tolerances asked for: the reference
  explicit_rk,     ///< ARKODE, explicit fourth order
  simbody_rkm,     ///< Simbody's RungeKuttaMerson
  simbody_cpodes,  ///< Simbody's CPodes
};

struct IntegratorOptions {
  IntegratorKind kind = IntegratorKind::dirk;
  double relative_tolerance = 1e-6;
  double absolute_tolerance = 1e-9;
};

/// One sine of a joint: amplitude sin(2π f t + phase).
struct Sine {
  double amplitude = 0, frequency_hz = 0, phase = 0;
};

/// What one joint is asked to follow: center + the sines, or moves between points with dwells, or samples.
struct JointTrajectory {
  enum class Kind { hold, sines, point_to_point, samples } kind = Kind::hold;
  double center = 0;  ///< rad | m
  std::vector<Sine> sines;
  std::vector<double> points;  ///< visited in order, over again, by minimum-jerk moves
  double move_s = 1, dwell_s = 0.5;
  std::vector<double> sample_time, sample_position;  ///< linear between, held outside
};

/// Standard deviations of normal numbers that are drawn afresh at every tick, [n]; empty: none.
struct TickNoise {
  std::vector<double> motor_torque;   ///< N m at the shaft, beside the command
  std::vector<double> joint_force;    ///< N m | N
  std::vector<double> motor_reading;  ///< rad, before it is rounded
};

/// A camera that sees a marker at the tool, where the model's payload hangs. A frame is in the log's row of its
/// arrival.
struct Camera {
  double rate_hz = 30;
  double latency_s = 0.05;  ///< from exposure to arrival
  double noise_m = 5e-4;    ///< standard deviation along each axis
  double dropout = 0.1;     ///< share of frames without the marker, each drawn by itself
};

struct Scenario {
  ArmModel robot;                                ///< the true one: effects and changed numbers of the truth included
  std::optional<ArmParameters<double>> assumed;  ///< what the controller takes the arm for; none: robot.nominal
  std::filesystem::path model;                   ///< the file that the robot was read from
  std::string name;
  double duration_s = 20;
  double control_period_s = 1e-3;
  double fade_in_s = 2;                     ///< sines grow from nothing over this time
  std::vector<JointTrajectory> trajectory;  ///< [n]
  IntegratorOptions integrator;
  bool quantise = true;  ///< round encoders to their resolution
  /// The motors' zeros were set at the home pose with unstretched cables, by what the controller takes the arm for:
  /// there they read right, whatever the robot's true ratios. What an effect adds to a reading comes on top.
  bool homed = false;
  TickNoise noise;
  std::optional<Camera> camera;
  std::uint64_t seed = 1;
};

/// Throws InputError if the scenario cannot be run: numbers out of range, desired motion beyond a joint's range.
void check_scenario(const Scenario& scenario);

/// Reads and checks a scenario file; paths in it are relative to it. robot: a model file of the true robot, which may
/// differ from the scenario's model in anything but its joints; the file's changes and effects come on top. Empty: the
/// robot is that of the model. Throws InputError.
Scenario read_scenario(const std::filesystem::path& path, const std::filesystem::path& robot = {});

}  // namespace halyard
