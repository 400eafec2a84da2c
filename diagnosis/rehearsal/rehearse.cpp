#include "diagnosis/rehearse.h"

#include <algorithm>
#include <new>

#include "diagnosis/diagnosis_details.h"
#include "diagnosis/holdout/holdout.h"
#include "diagnosis/log_check/own_readings.h"
#include "diagnosis/plan.h"
#include "diagnosis/record/common_clock.h"
#include "diagnosis/rehearsal/drawn_effect.h"
#include "diagnosis/rehearsal/rehearsed_log.h"
#include "diagnosis/rehearsal/true_names.h"
#include "model/input_error.h"

namespace halyard {
namespace {

constexpr std::size_t kMostDrawn = 3;  // effects of one rehearsal
constexpr int kMostDraws = 20;         // of effects with which the arm can be integrated

/// Streams of random numbers that have nothing in common.
enum Stream : std::uint32_t { kEffects, kNoise, kWithoutEffect };

std::vector<const Effect*> effects_to_draw() {
  std::vector<const Effect*> effects = effect_library();
  std::erase_if(effects, [](const Effect* e) { return e->stages() & static_cast<unsigned>(EffectStage::command); });
  return effects;
}

/// The rehearsals of one diagnosis.
class Rehearser {
 public:
  Rehearser(const ArmModel& model, const Diagnosis& d, const std::vector<Log>& training,
            const std::optional<Log>& holdout, const DiagnosisOptions& how)
      : model_(model), d_(d), how_(how), arm_(d.given) {
    how_.tell_not_excited = false;
    const UsableLogs logs = usable_logs(model, training, holdout, how.columns.value_or(model.columns));
    const std::vector<double> shifts = clock_shifts(logs.training);
    for (std::size_t i = 0; i < logs.training.size(); ++i)
      training_.push_back(motion_of(logs.training[i], found(), shifts[i]));
    const ArmModel on_holdout = d.revised_on_holdout();
    if (logs.holdout) holdout_ = motion_of(*logs.holdout, {on_holdout.nominal, on_holdout.effects}, 0);
    arm_.nominal = found().nominal;
    const Log& first = logs.training.front();
    range_ = motion_range(training_.front().records(), arm_.nominal);
    if (!holdout) range_.record.to = first.time.front() + kTrainingShare * first.duration();
  }

  /// The rehearsals of this seed, not diagnosed yet.
  std::vector<Rehearsal> draw(int count, std::uint64_t seed) const {
    std::vector<Rehearsal> all(count);
    std::vector<PlacedEffect> drawn;
    for (int i = 0; i < count; ++i) {
      all[i].truth = truth_of(i);
      if (all[i].truth == RehearsedTruth::found)  // of what was found, only names are to be found again
        for (const NamedEffect& e : d_.effects) all[i].hidden.push_back({e.effect, true, false});
      if (all[i].truth != RehearsedTruth::drawn) continue;
      Random random(seed, kEffects, static_cast<std::uint32_t>(i));
      for (const PlacedEffect& e : draw_effects(random)) {
        all[i].hidden.push_back({e, false, false});
        drawn.push_back(e);
      }
    }
    if (drawn.empty()) return all;
    const std::vector<double> seen_from = detected_from(arm_, without_effect(seed), drawn);
    std::size_t next = 0;
    for (Rehearsal& r : all)
      if (r.truth == RehearsedTruth::drawn)
        for (HiddenEffect& h : r.hidden) h.is_visible = seen_from[next++] <= 1;
    return all;
  }

  void run(Rehearsal& rehearsal, std::uint64_t seed, int index) const {
    try {
      Random random(seed, kNoise, static_cast<std::uint32_t>(index));
      Hypothesis truth = {arm_.nominal, arm_.effects};
      if (rehearsal.truth == RehearsedTruth::found) truth = found();
      if (rehearsal.truth == RehearsedTruth::drawn)
        for (const HiddenEffect& h : rehearsal.hidden) truth.effects.push_back(h.effect);
      std::vector<Log> training;
      for (const LoggedMotion& motion : training_) training.push_back(motion.as_of(truth, random));
      std::optional<Log> holdout;
      if (holdout_) holdout = holdout_->as_of(elsewhere(std::move(truth)), random);
      const Diagnosis d = diagnose(model_, training, holdout, how_);
      rehearsal.verdict = d.verdict;
      rehearsal.unexplained = d.unexplained;
      score_names(d.effects, neither_right_nor_false(rehearsal), model_.n(), rehearsal);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {  // a log that is refused, or an effect of a user's own that throws
      rehearsal.failure = error.what();
    }
  }

 private:
  std::size_t n_given() const { return d_.given.effects.size(); }
  /// On the common clock of the training logs.
  const Hypothesis& found() const { return d_.details->attribution.final_fit.hypothesis; }

  RehearsedTruth truth_of(int index) const {
    switch (index % 4) {
      case 0: return d_.effects.empty() ? RehearsedTruth::nothing : RehearsedTruth::found;
      case 1: return RehearsedTruth::nothing;
      default: return RehearsedTruth::drawn;
    }
  }

  LoggedMotion motion_of(const Log& log, const Hypothesis& found, double clock_shift) const {
    const auto told = std::ranges::find(d_.details->late, log.source, &DiagnosisData::Late::log);
    const double late = told == d_.details->late.end() ? 0 : told->seconds;
    std::vector<Record> records = rehearsal_records(log, model_);
    const std::vector<Record>& seen = d_.details->training;
    for (Record& r : records) {
      r.clock_shift = clock_shift;
      for (std::size_t place = 0; place < seen.size(); ++place)
        if (seen[place].source == r.source && seen[place].start == r.start) r.place = place;
    }
    return {log, std::move(records), late, model_, found};
  }

  /// As many as were found; other ones if the arm cannot be integrated with them.
  std::vector<PlacedEffect> draw_effects(Random& random) const {
    const std::size_t n_found = d_.revised.effects.size() - n_given();
    for (int draw = 1;; ++draw) {
      Hypothesis truth{arm_.nominal, arm_.effects};
      for (std::size_t i = 0; i < std::clamp<std::size_t>(n_found, 1, kMostDrawn); ++i)
        if (auto effect = draw_effect(effects_to_draw(), arm_, truth.effects, nullptr, random)) {
          draw_parameters(*effect, arm_, range_, random);
          truth.effects.push_back(*effect);
        }
      const Record& record = training_.front().records().front();
      if (draw == kMostDraws || predict(record, {truth}, 1)[0].finite)
        return {truth.effects.begin() + static_cast<std::ptrdiff_t>(n_given()), truth.effects.end()};
    }
  }

  /// In a log of its own: what happens at an instant of the training happens in no other log, and its effects start
  /// without a past. Events of the given model stay, as they do in a diagnosis.
  Hypothesis elsewhere(Hypothesis truth) const {
    truth.past.clear();
    const auto added = truth.effects.begin() + static_cast<std::ptrdiff_t>(n_given());
    truth.effects.erase(
        std::remove_if(added, truth.effects.end(), [&](const PlacedEffect& e) { return is_event(e, arm_.nominal); }),
        truth.effects.end());
    return truth;
  }

  /// The training logs as the arm without an effect would have given them, for a plan, which takes no lateness out.
  std::vector<Log> without_effect(std::uint64_t seed) const {
    Random random(seed, kWithoutEffect, 0);
    std::vector<Log> logs;
    for (const LoggedMotion& motion : training_) {
      Log log = motion.on_time_as_of({arm_.nominal, arm_.effects}, random);
      logs.push_back(holdout_ ? std::move(log) : split_log(log, kTrainingShare).first);
    }
    return logs;
  }

  std::vector<PlacedEffect> neither_right_nor_false(const Rehearsal& rehearsal) const {
    std::vector<PlacedEffect> effects = effects_beyond_tolerance(model_, arm_.nominal);
    for (const HiddenEffect& h : rehearsal.hidden)
      for (const std::string& name : names_of_parts(h.effect.effect->name()))
        effects.push_back({find_effect(name), h.effect.joint});
    if (rehearsal.truth != RehearsedTruth::found) return effects;
    for (std::size_t i = n_given(); i < d_.revised.effects.size(); ++i)  // those that got no name
      if (std::ranges::find(d_.effects, i, &NamedEffect::index) == d_.effects.end())
        effects.push_back(d_.revised.effects[i]);
    return effects;
  }

  const ArmModel& model_;
  const Diagnosis& d_;
  DiagnosisOptions how_;
  std::vector<LoggedMotion> training_;
  std::optional<LoggedMotion> holdout_;
  ArmModel arm_;  ///< as the given one, with the numbers that were found
  MotionRange range_;
};

}  // namespace

Rehearsals rehearse(const ArmModel& model, const Diagnosis& d, const std::vector<Log>& training,
                    const std::optional<Log>& holdout, const RehearsalOptions& options, const DiagnosisOptions& how,
                    const std::function<void(const std::string&, double)>& progress) {
  const auto say = [&](double done) {
    if (progress) progress("rehearsals", done / options.count);
  };
  say(0);
  const Rehearser rehearser(model, d, training, holdout, how);
  Rehearsals rehearsals{options.seed, rehearser.draw(options.count, options.seed)};
  for (int i = 0; i < options.count; ++i) {
    say(i);
    rehearser.run(rehearsals.all[i], options.seed, i);
  }
  return rehearsals;
}

}  // namespace halyard
