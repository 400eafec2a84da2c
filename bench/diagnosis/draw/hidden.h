#pragma once
/// What is hidden: effects, their sizes, an arm off its model. The rules are told in trial/trial.h.

#include "bench/diagnosis/draw/random.h"
#include "bench/diagnosis/results/result.h"
#include "model/arm_model.h"

namespace halyard::blind {

/// An effect that acts, and under which name it should be found.
struct Hidden {
  PlacedEffect acts;
  std::string right_name;
  std::string right_beside = {};  ///< OtherForm::beside
};

/// Names that are right beside it: of a part of it; of friction that drifts, other friction than the model's.
std::vector<std::string> names_beside(const Hidden& hidden);

/// What the motion of a trial limits: where instants and positions can lie, how fast is near standstill, and of which
/// orders the motion has enough periods.
struct Range {
  double from = 0, to = 0;
};
struct Ranges {
  Range record;                 ///< s, of the training log
  std::vector<Range> joint;     ///< [n]
  std::vector<double> fastest;  ///< [n] speed of the joint, rad/s | m/s
};

/// The place of an effect in an arm of so many joints. In an arm of one joint the arm and the joint are the same.
Place place_of(const PlacedEffect& effect, int joints);

/// The effects of trial `index` of this kind, with their places but without sizes; none for the clean ones.
/// Throws std::runtime_error if the arm cannot have as many.
std::vector<Hidden> draw_effects(const ArmModel& model, Kind kind, int index, Random& random);
/// An effect is drawn as the library means it, within what the diagnosis takes for it: Stribeck's speed lies near
/// standstill, and the motion has at least kFewestPeriods periods of an order, if it has them of any.
void draw_parameters(PlacedEffect& effect, const ArmModel& model, const Ranges& ranges, Random& random);

/// The largest of the effect's sizes over the typical one.
double relative_size(const PlacedEffect& effect, const ArmModel& model);
std::vector<TrueParameter> true_parameters(const PlacedEffect& effect, const ArmModel& model);

/// Moves the robot's parameters that have a tolerance by up to `off` tolerances, uniformly. The ratio of a drive is one
/// parameter, as in the diagnosis. Parameters that a hidden effect changes stay: their whole change is the effect's.
void mistune(ArmModel& robot, int off, const std::vector<Hidden>& hidden, Random& random);
/// Names of the library for parameters of the robot that are off the model's by more than their tolerance.
std::vector<Place> names_beyond_tolerance(const ArmModel& model, const ArmModel& robot);

}  // namespace halyard::blind
