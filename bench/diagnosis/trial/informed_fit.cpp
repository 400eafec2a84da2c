#include "bench/diagnosis/trial/informed_fit.h"

#include <algorithm>

#include "diagnosis/holdout/holdout.h"
#include "diagnosis/judgement/final_fit.h"
#include "diagnosis/log_check/own_readings.h"
#include "diagnosis/round/refit.h"
#include "diagnosis/search/basis.h"

namespace halyard::blind {

std::optional<ArmModel> informed_fit(const ArmModel& given, const Recording& recording, int off) {
  const bool are_listed =
      std::ranges::all_of(recording.hidden, [](const Hidden& h) { return h.acts.effect->name() == h.right_name; });
  if (!are_listed) return {};
  const ArmModel tolerated = with_tolerances_times(std::max(1, off), given);
  const Log log = usable_readings(recording.training, given);
  const std::vector<Record> records = diagnosis_data(given, {log}, recording.holdout, given).training;
  const Evidence evidence(records, given), whole(records, given, Split::none);
  const Hypothesis start{given.nominal, recording.robot.effects, {}};
  const Fit refitted = Refitter(evidence, tolerated, 0).refit(start, evidence.score(start));
  if (!refitted.usable) return {};
  const Fit fit = final_fit(whole, tolerated, refitted, 0);
  if (!fit.usable) return {};
  ArmModel informed = given;
  informed.nominal = fit.hypothesis.nominal;
  informed.effects = fit.hypothesis.effects;
  return informed;
}

}  // namespace halyard::blind
