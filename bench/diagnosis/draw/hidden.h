#pragma once
/// What is hidden: effects, and an arm off its model. The rules are told in trial/trial.h.

#include "bench/diagnosis/results/result.h"
#include "diagnosis/rehearsal/drawn_effect.h"
#include "model/arm_model.h"

namespace halyard::blind {

/// An effect that acts, and under which name it should be found.
struct Hidden {
  PlacedEffect acts;
  std::string right_name;
  std::string right_beside = {};  ///< OtherForm::beside
};

/// Names that are right beside it: OtherForm::beside, and names_of_parts().
std::vector<std::string> names_beside(const Hidden& hidden);

/// The place of an effect in an arm of so many joints. In an arm of one joint the arm and the joint are the same.
Place place_of(const PlacedEffect& effect, int joints);

/// The effects of trial `index` of this kind, with their places but without sizes; none for the clean ones.
/// Throws std::runtime_error if the arm cannot have as many.
std::vector<Hidden> draw_effects(const ArmModel& model, Kind kind, int index, Random& random);

/// The largest of the effect's sizes over the typical one.
double relative_size(const PlacedEffect& effect, const ArmModel& model);
std::vector<TrueParameter> true_parameters(const PlacedEffect& effect, const ArmModel& model);

/// Moves the robot's parameters that have a tolerance by up to `off` tolerances, uniformly. The ratio of a drive is one
/// parameter, as in the diagnosis. Parameters that a hidden effect changes stay: their whole change is the effect's.
void mistune(ArmModel& robot, int off, const std::vector<Hidden>& hidden, Random& random);
/// Names of the library for parameters of the robot that are off the model's by more than their tolerance.
std::vector<Place> names_beyond_tolerance(const ArmModel& model, const ArmModel& robot);

}  // namespace halyard::blind
