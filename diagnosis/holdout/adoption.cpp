#include "diagnosis/holdout/adoption.h"

#include "diagnosis/judgement/final_fit.h"
#include "diagnosis/record/common_clock.h"
#include "diagnosis/search_space.h"

namespace halyard {
namespace {

/// Predicts the hold-out with a revised model, and judges its errors.
class Trier {
 public:
  Trier(const AdoptionTask& task, HoldOut& joints, HoldOut& torques)
      : task_(task), joints_(joints), torques_(torques), given_(task.given.effects.size()) {}

  /// HoldOut::after by the fit; returns its absent events.
  std::vector<std::size_t> predict(const Hypothesis& revised) {
    std::vector<std::size_t> absent;
    Hypothesis on_holdout = revised;
    double least = error_of(on_holdout);
    bool is_predicted = true;
    for (std::size_t e = on_holdout.effects.size(); task_.has_own_log && e-- > given_;) {
      if (!is_event(on_holdout.effects[e], task_.given.nominal)) continue;
      const Hypothesis without = without_effect(on_holdout, e);
      const double error = error_of(without);
      is_predicted = error < least;
      if (!is_predicted) continue;
      absent.push_back(e);
      on_holdout = without;
      least = error;
    }
    if (!is_predicted) error_of(on_holdout);
    return absent;
  }

  std::vector<int> worse(const std::vector<double>& floor) const {
    return worse_joints(task_.given, joints_, torques_, floor);
  }

 private:
  double error_of(const Hypothesis& on_common_clock) {
    const Hypothesis h = on_holdout_clock(task_, on_common_clock);
    for (HoldOut* view : {&joints_, &torques_}) view->after = predict_all(view->records, h);
    return error_over_floors(task_.given, joints_, torques_, &HoldOut::after, task_.evidence.floor());
  }

  const AdoptionTask& task_;
  HoldOut &joints_, &torques_;
  std::size_t given_;
};

}  // namespace

Adoption adopted_on_holdout(const AdoptionTask& task, Revised revised, HoldOut& joints, HoldOut& torques) {
  Trier trier(task, joints, torques);
  Adoption a{std::move(revised), {}, {}};
  a.absent_events = trier.predict(a.revised.fit.hypothesis);
  if (a.revised.fit.hypothesis.effects.size() == task.given.effects.size() && a.revised.changed.empty()) return a;
  a.worse = trier.worse(task.evidence.floor());
  if (a.worse.empty()) return a;
  // What numbers explain within their tolerances is not unexplained because other data want others.
  if (const Fit fit = with_given_motion(task.whole, task.tolerated, a.revised.fit); fit.usable) {
    a.revised = {fit, changed_numbers(task.whole, task.tolerated, fit)};
    a.absent_events = trier.predict(fit.hypothesis);
    a.worse = trier.worse(holdout_floors(task.evidence, task.tolerated, joints, torques));
  }
  if (a.worse.empty()) return a;
  a.absent_events.clear();
  for (HoldOut* view : {&joints, &torques}) view->after = view->before;
  return a;
}

Hypothesis on_holdout_clock(const AdoptionTask& task, const Hypothesis& on_common_clock) {
  if (!task.has_own_log) return on_common_clock;
  return on_clocks_of_their_logs(on_common_clock, task.given.effects.size(), task.given.nominal,
                                 task.evidence.records());
}

}  // namespace halyard
