#pragma once
/// A blind trial: an arm with a hidden truth moves at random, and diagnose() is asked what the model lacks.
///
///   clean_exact      nothing; the model's numbers are the arm's
///   clean_mistuned   nothing; every number off within its stated tolerance, uniformly
///   effect           one effect of the library
///   effect_mistuned  one effect of the library, and numbers as in clean_mistuned
///   form             one effect in another functional form than the library's
///   outside          one effect for which the library has no name
///   pair             two effects of the library at different places
///   each_effect      one effect of the library, every one in turn, so that each is asked for equally often
///
/// Effects are drawn uniformly (in `each_effect` the trial's number tells), then their place. Each of an effect's sizes is present with probability 1/2, at least
/// one is: typical size times log-uniform 0.5 to 3, of random sign where the bounds allow both, at most 95 % of the way
/// to a bound that is no limit of nature. Shapes are one of the effect's starts, or typical times log-uniform 0.5 to 2.
/// An instant lies in the first 10 to 70 % of the training, a position in the middle 60 % of the joint's motion.
/// `effect` and `effect_mistuned` are drawn anew while the strength (strength.h) is below 1: there is nothing to see.
/// In the other kinds the sizes are raised until every effect is stronger than the limit.
///
/// Logs start after the motion has faded in: 15 s of training, and 6 s of another motion as hold-out. Where an effect
/// happens at an instant, one log of 21 s holds both. Encoders are rounded, motors disturbed by up to 0.2 mN m, control
/// gains scatter by ±40 %.

#include <cstdint>
#include <filesystem>

#include "bench/diagnosis/result.h"
#include "model/arm_model.h"

namespace halyard::blind {

struct TrialOptions {
  std::uint64_t seed = 1;
  double limit = 6;            ///< strength above which an effect has to be found
  std::filesystem::path logs;  ///< folder for the logs that were diagnosed; empty: they are not kept
};

/// Depends on its arguments alone. A trial that cannot be run tells why in Result::failure.
Result run_trial(const ArmModel& model, Kind kind, int index, const TrialOptions& options);

}  // namespace halyard::blind
