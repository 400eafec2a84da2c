#pragma once
/// Which of a robot's effects makes how much of the estimators' errors, by switching them on one by one, and off one by
/// one. Effects do not add up: what one makes alone and what is gone without it are two answers.

#include <functional>
#include <string>
#include <vector>

#include "model/arm_model.h"
#include "plant/scenario.h"

namespace halyard {

/// A robot with some of its effects, and how the estimators did on it.
struct StudiedRobot {
  enum class Has { none, one, all, all_but_one } has = Has::none;
  std::string effect;  ///< the one; of all joints. kCableLaw: the cables' law in place of the model's
  /// [estimator][joint] mean absolute error, SI, mean of the scenarios.
  std::vector<std::vector<double>> error;

  std::string name() const;  ///< "capstan_ratio alone"
};

/// Stands among the effects for cables whose law is not the model's.
inline constexpr const char* kCableLaw = "cable law";

struct EffectStudy {
  std::vector<std::string> estimators;
  std::vector<std::string> effects;
  std::vector<StudiedRobot> robots;  ///< none, each alone, all, all but each

  const StudiedRobot& robot(StudiedRobot::Has has, const std::string& effect = "") const;
};

/// What distinguishes the scenarios' robots from the model: the names of their effects, in the order of the scenarios.
std::vector<std::string> effects_of(const std::vector<Scenario>& scenarios, const ArmModel& model);

/// The scenario with those of its robot's effects alone that are named.
Scenario with_effects(Scenario scenario, const ArmModel& model, const std::vector<std::string>& effects);

/// Simulates every robot in every scenario, in parallel, and runs the estimators with the model over it; errors count
/// from skip_s on. The result does not depend on the number of threads. progress(fraction) may be called from any
/// thread. Throws as simulate and run_contained do.
EffectStudy study_effects(const std::vector<Scenario>& scenarios, const ArmModel& model,
                          const std::vector<std::string>& estimators, double skip_s,
                          const std::function<void(double)>& progress = {});

}  // namespace halyard
