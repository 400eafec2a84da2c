#pragma once
/// A scenario: a robot with its true effects, the motion that it is asked to follow, and how the simulation computes
/// it. The initial values of the members are the defaults; a scenario file has the same structure.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "model/arm_model.h"
#include "model/log.h"
#include "plant/engine.h"

namespace halyard {

/// How the plant is integrated; docs/architecture.md explains the purpose of each kind.
enum class IntegratorKind {
  automatic,       ///< rosenbrock, unless an effect acts at the command stage: then dirk (default)
  rosenbrock,      ///< Rosenbrock's, fourth order, with the exact Jacobian
  dirk,            ///< ARKODE, diagonally implicit third order: all implicit
  imex,            ///< ARKODE, fourth order: cables and friction implicit, the rest explicit
  imex_link1,      ///< ARKODE, fourth order: only the first link's cable implicit
  bdf,             ///< CVODE at 1e-5 times the given tolerances: the reference
  explicit_rk,     ///< ARKODE, explicit fourth order
  simbody_rkm,     ///< Simbody's RungeKuttaMerson
  simbody_cpodes,  ///< Simbody's CPodes
};

/// True for Simbody's own integrators. They need Engine::simbody, and have no absolute tolerance.
inline bool is_of_simbody(IntegratorKind kind) {
  return kind == IntegratorKind::simbody_rkm || kind == IntegratorKind::simbody_cpodes;
}

struct IntegratorOptions {
  IntegratorKind kind = IntegratorKind::automatic;
  double relative_tolerance = 1e-6;
  double absolute_tolerance = 1e-9;
};

/// One sine of a joint: amplitude · sin(2π f t + phase). amplitude: rad | m; phase: rad.
struct Sine {
  double amplitude = 0, frequency_hz = 0, phase = 0;
};

/// Desired motion of one joint (equations: trajectory.h).
struct JointTrajectory {
  enum class Kind { hold, sines, point_to_point, samples } kind = Kind::hold;
  double center = 0;  ///< rad | m
  std::vector<Sine> sines;
  std::vector<double> points;  ///< visited in order, repeatedly, by minimum-jerk moves, rad | m
  double move_s = 1, dwell_s = 0.5;
  std::vector<double> sample_time, sample_position;  ///< s, rad | m; linear between, constant outside
  std::filesystem::path file;                        ///< CSV file that the samples were read from, if any
  std::string column;                                ///< and their column in it
};

/// Standard deviations of Gaussian noise, drawn independently at each tick, [n]; empty: no noise.
struct TickNoise {
  std::vector<double> motor_torque;   ///< N m at the shaft, added to the torque command
  std::vector<double> joint_force;    ///< N m | N
  std::vector<double> motor_reading;  ///< rad, added before rounding
  std::vector<double> joint_reading;  ///< rad | m, added before rounding
};

/// A camera that sees a marker at the tool, at the model's payload point. The log has each frame in the row in which it
/// arrives.
struct Camera {
  double rate_hz = 30;
  double latency_s = 0.05;  ///< from exposure to arrival
  double noise_m = 5e-4;    ///< standard deviation along each axis
  double dropout = 0.1;     ///< probability that a frame misses the marker, independent of other frames
};

struct Scenario {
  ArmModel robot;  ///< the true robot, with its effects and changed parameters
  /// The model, with its effects, by which the controller turns desired joint positions into readings of the motors,
  /// and by which they are homed; none: robot.nominal, without effects. The controller's gains are those of the robot.
  std::optional<ArmModel> assumed;
  std::filesystem::path model;  ///< the file that the robot was read from
  std::string name;
  double duration_s = 20;
  double control_period_s = 1e-3;
  double fade_in_s = 2;                     ///< sines grow from zero over this time
  std::vector<JointTrajectory> trajectory;  ///< [n]
  /// None: the reference, Engine::simbody, in simulate(); studies of many runs take Engine::halyard (faster()).
  std::optional<Engine> engine;
  IntegratorOptions integrator;
  bool quantise = true;  ///< round encoders to their resolution
  /// True: the zeros of the motor encoders were set at the home pose, with unstretched cables. They were computed with
  /// the parameters that the controller assumes. Readings are then correct at that pose, whatever the robot's true
  /// ratios and offsets. What effects add to a reading or to a stretch (encoder_eccentricity, capstan_eccentricity) is
  /// not part of these parameters, and remains as an error at that pose.
  bool homed = false;
  TickNoise noise;
  std::optional<Camera> camera;
  std::uint64_t seed = 1;
};

/// The scenario with Engine::halyard, if it does not choose an engine, nor an integrator that needs Simbody.
Scenario faster(Scenario scenario);

/// Throws InputError if the scenario cannot be run: numbers out of range, desired motion beyond a joint's range.
void check_scenario(const Scenario& scenario);

/// Reads and checks a scenario file; paths in it are relative to it. robot: a model file of the true robot, with the
/// same joints as the scenario's model; everything else may differ. The scenario's changes and effects are applied to
/// it. If robot is empty, the robot is the scenario's model. Throws InputError.
Scenario read_scenario(const std::filesystem::path& path, const std::filesystem::path& robot = {});

/// The text of a scenario file for the folder `folder`, which read_scenario() reads as this scenario again. The robot
/// must be that of the model file `model`, and the controller must assume the same: neither changes of its numbers nor
/// effects are written. Throws std::invalid_argument for what no file can say: samples that were not read from one, and
/// noise of the joints' forces.
std::string scenario_xml(const Scenario& scenario, const std::filesystem::path& model,
                         const std::filesystem::path& folder);

}  // namespace halyard
