#pragma once
/// A blind trial: an arm with a hidden truth moves at random, and diagnose() is asked what the model lacks.
///
/// The trial's situation says what is hidden (results/situation.h), its number which effect: `effect`, `form` and
/// `outside` take every one in turn. Arms, sensors and motions are drawn as draw/arms.h, draw/sensors.h and
/// draw/motion.h say. Then the place of the effect is drawn, and its parameters as diagnosis/rehearsal/drawn_effect.h
/// says. Effects that are too small to be seen (recording.h) stay in, and are counted apart.
///
/// Every parameter with a tolerance is off by up to Situation::off tolerances, uniformly, except those whose place a
/// hidden effect takes: their change is the effect's.
///
/// Logs start after the motion has faded in: 30 s of training, and 10 s of another motion as hold-out, whose sensors
/// have no noise. Errors are also counted against the hold-out as the training's sensors would read it. Both have the
/// same clock, which starts with each run: what happens at an instant happens in both.
/// Motors are disturbed by up to 5 % of their friction, control gains scatter by ±40 %.

#include <cstdint>
#include <filesystem>

#include "bench/diagnosis/results/result.h"
#include "model/arm_model.h"

namespace halyard::blind {

struct TrialOptions {
  std::uint64_t seed = 1;
  std::string rule;            ///< thresholds that were varied, "NAME=VALUE NAME=VALUE"; empty: none
  double outliers = 0;         ///< share of joint readings of the training that are wrong by 50 to 500 counts
  std::filesystem::path logs;  ///< folder for the logs and models that were diagnosed; empty: they are not kept
};

/// Depends on its arguments alone. Arm, places, sizes, motion and sensors are drawn again if they cannot be recorded
/// (recording.h), at most kMostDraws times; Result::dropped tells why. A trial that cannot be run tells why in
/// Result::failure.
Result run_trial(const ArmModel& raven2, const Situation& situation, int index, const TrialOptions& options);

}  // namespace halyard::blind
