#pragma once
/// Contribution of each of a robot's effects to the estimators' errors. Each effect is switched on alone, and switched
/// off alone. The two answers differ, because the error that several effects cause together is not the sum of the
/// errors that each causes alone.

#include <functional>
#include <string>
#include <vector>

#include "model/arm_model.h"
#include "plant/scenario.h"

namespace halyard {

/// A robot with some of its effects, and the estimators' errors on it.
struct StudiedRobot {
  enum class Has { none, one, all, all_but_one } has = Has::none;
  /// If `has` is Has::one or Has::all_but_one: name of the effect, on all joints. kCableLaw stands for the robot's
  /// cable law.
  std::string effect;
  /// [estimator][joint] mean absolute error, SI, mean of the scenarios.
  std::vector<std::vector<double>> error;

  std::string name() const;  ///< "capstan_ratio alone"
};

/// The entry in lists of effects for a cable law that differs from the model's.
inline constexpr const char* kCableLaw = "cable law";

struct EffectStudy {
  std::vector<std::string> estimators;
  std::vector<std::string> effects;
  /// in this order: without effects; with each effect alone; with all effects; without each effect
  std::vector<StudiedRobot> robots;

  const StudiedRobot& robot(StudiedRobot::Has has, const std::string& effect = "") const;
};

/// Names of the effects by which the scenarios' robots differ from the model, in the order of the scenarios.
std::vector<std::string> effects_of(const std::vector<Scenario>& scenarios, const ArmModel& model);

/// The scenario with only these effects of its robot.
Scenario with_effects(Scenario scenario, const ArmModel& model, const std::vector<std::string>& effects);

/// Simulates every robot in every scenario, in parallel, and runs the estimators with the model over the logs. The
/// first skip_s seconds are not counted in the errors. The result does not depend on the number of threads.
/// progress(fraction) may be called from any thread. Throws as simulate and run_contained do.
EffectStudy study_effects(const std::vector<Scenario>& scenarios, const ArmModel& model,
                          const std::vector<std::string>& estimators, double skip_s,
                          const std::function<void(double)>& progress = {});

}  // namespace halyard
