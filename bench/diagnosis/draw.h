#pragma once
/// What is hidden: effects, their sizes, an arm off its model. The rules are told in trial.h.

#include "bench/diagnosis/random.h"
#include "bench/diagnosis/result.h"
#include "model/arm_model.h"

namespace halyard::blind {

/// An effect that acts, and under which name it should be found.
struct Hidden {
  PlacedEffect acts;
  std::string right_name;
};

/// Where parameters that lie within the record or the motion can lie.
struct Range {
  double from = 0, to = 0;
};
struct Ranges {
  Range record;              ///< s, of the training log
  std::vector<Range> joint;  ///< [n]
};

/// An effect and its place for trial `index` of this kind; no effect for the clean ones. `beside`: what is hidden
/// already.
Hidden draw_effect(const ArmModel& model, Kind kind, int index, const std::vector<Hidden>& beside, Random& random);
void draw_parameters(PlacedEffect& effect, const ArmModel& model, const Ranges& ranges, Random& random);

/// Moves all sizes away from neutral; false if they are at the end of what may be.
bool enlarge(PlacedEffect& effect, const ArmModel& model, double factor);
/// The largest of the effect's sizes over the typical one.
double relative_size(const PlacedEffect& effect, const ArmModel& model);
std::vector<TrueParameter> true_parameters(const PlacedEffect& effect, const ArmModel& model);
/// True if the effect happens at an instant of the record.
bool happens_at_an_instant(const PlacedEffect& effect, const ArmModel& model);

/// Numbers with a tolerance are somewhere within it. The ratio of a drive is one number, as in the diagnosis; masses'
/// centres and inertias are off as well.
void mistune(ArmModel& robot, Random& random);

}  // namespace halyard::blind
