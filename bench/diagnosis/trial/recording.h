#pragma once
/// What a trial records: a training log and a hold-out of an arm whose truth is hidden. The rules are told in trial.h.
///
/// An effect counts as visible from the size on that `--plan` promises beforehand (diagnosis/plan.h, detected_from()):
/// for the model as it is given, in the training's motion, with the same sensors. The plan knows neither the other
/// effects nor the parameters that are off. Of an effect above the compared band, a count of the motor's encoder is the
/// limit. A single effect of the library is promised a name from a larger size on (named_from()), because other effects
/// may look like it.

#include <limits>

#include "bench/diagnosis/draw/hidden.h"
#include "bench/diagnosis/draw/sensors.h"
#include "bench/diagnosis/trial/trial.h"
#include "model/log.h"

namespace halyard::blind {

/// What the diagnosis is given, and what it is not.
struct Recording {
  ArmModel model;         ///< given
  Log training, holdout;  ///< given; the hold-out's sensors have no noise
  Log sensed_holdout;     ///< the same motion as the hold-out, read by the training's sensors
  ArmModel robot;         ///< the truth
  SensorDraw sensors;
  std::vector<Hidden> hidden;
  std::vector<double> seen_from;                                ///< of each hidden effect, see TrueEffect::seen_from
  double named_from = std::numeric_limits<double>::infinity();  ///< see TrueEffect::named_from
};

/// Throws std::runtime_error if what was drawn cannot be recorded: the controller lost the arm, for example.
Recording draw_recording(const ArmModel& raven2, const Situation& situation, int index, const TrialOptions& options,
                         Random& random);

}  // namespace halyard::blind
