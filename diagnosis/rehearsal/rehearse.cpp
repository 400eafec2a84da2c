#include "diagnosis/rehearse.h"

#include <algorithm>

#include "diagnosis/diagnosis_details.h"
#include "diagnosis/holdout/holdout.h"
#include "diagnosis/log_check/own_readings.h"
#include "diagnosis/plan.h"
#include "diagnosis/record/common_clock.h"
#include "diagnosis/rehearsal/drawn_effect.h"
#include "diagnosis/rehearsal/rehearsed_log.h"
#include "model/input_error.h"

namespace halyard {
namespace {

constexpr std::size_t kMostDrawn = 3;  // effects of one rehearsal
constexpr int kMostDraws = 20;         // of effects with which the arm can be integrated

/// Streams of random numbers that have nothing in common.
enum Stream : std::uint32_t { kRehearsals, kWithoutEffect };

std::vector<const Effect*> effects_to_draw() {
  std::vector<const Effect*> effects = effect_library();
  std::erase_if(effects, [](const Effect* e) { return e->stages() & static_cast<unsigned>(EffectStage::command); });
  return effects;
}

/// In an arm of one joint, an effect of the arm and of the joint are the same.
bool is_same_place(const PlacedEffect& a, const PlacedEffect& b, int joints) {
  return joints == 1 || a.joint == b.joint;
}

/// The names that a rehearsal gave, each compared with the truth once: a second name for the same effect is false.
void score(RehearsedLog& log, const Diagnosis& d, const std::vector<PlacedEffect>& neither) {
  const int n = d.given.n();
  for (const NamedEffect& name : d.effects) {
    const auto is_name = [&](const PlacedEffect& e) {
      return e.effect == name.effect.effect && is_same_place(e, name.effect, n);
    };
    const auto truth =
        std::ranges::find_if(log.hidden, [&](const HiddenEffect& h) { return !h.is_named && is_name(h.effect); });
    const bool is_right = truth != log.hidden.end();
    if (is_right) truth->is_named = true;
    else if (std::ranges::any_of(neither, is_name)) continue;
    log.names.push_back({name.effect, name.probability, is_right});
  }
}

/// The rehearsals of one diagnosis.
class Rehearser {
 public:
  Rehearser(const ArmModel& model, const Diagnosis& d, const std::vector<Log>& training,
            const std::optional<Log>& holdout, const DiagnosisOptions& how)
      : model_(model), d_(d), how_(how) {
    how_.tell_not_excited = false;
    const UsableLogs logs = usable_logs(model, training, holdout, how.columns.value_or(model.columns));
    const std::vector<double> shifts = clock_shifts(logs.training);
    const Hypothesis& found = d.details->attribution.final_fit.hypothesis;
    for (std::size_t i = 0; i < logs.training.size(); ++i)
      training_.push_back(motion_of(logs.training[i], found, shifts[i]));
    const ArmModel on_holdout = d.revised_on_holdout();
    if (logs.holdout) holdout_ = motion_of(*logs.holdout, {on_holdout.nominal, on_holdout.effects}, 0);
    arm_ = d.given;
    arm_.nominal = found.nominal;
    const Log& first = logs.training.front();
    range_ = motion_range(training_.front().records(), arm_.nominal);
    if (!holdout) range_.record.to = first.time.front() + kTrainingShare * first.duration();
  }

  RehearsedLog run(std::uint64_t seed, std::uint32_t index) const {
    Random random(seed, kRehearsals, index);
    RehearsedLog log;
    log.truth = truth_of(index);
    try {
      const Made made = make(log.truth, random);
      log.hidden = hidden_of(made, log.truth, seed);
      const Diagnosis d = diagnose(model_, made.training, made.holdout, how_);
      log.verdict = d.verdict;
      score(log, d, neither_right_nor_false(log));
    } catch (const InputError& error) {
      log.failure = error.what();
    }
    return log;
  }

 private:
  struct Made {
    std::vector<PlacedEffect> effects;  ///< beside those of the given model
    std::vector<Log> training;
    std::optional<Log> holdout;
  };

  std::size_t n_given() const { return d_.given.effects.size(); }
  std::size_t n_found() const { return d_.revised.effects.size() - n_given(); }

  RehearsedTruth truth_of(std::uint32_t index) const {
    switch (index % 4) {
      case 0: return n_found() > 0 ? RehearsedTruth::found : RehearsedTruth::nothing;
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

  /// Draws again if the arm cannot be integrated.
  Made make(RehearsedTruth truth, Random& random) const {
    for (int draw = 1;; ++draw) try {
        return make_once(truth, random);
      } catch (const InputError&) {
        if (draw == kMostDraws) throw;
      }
  }

  Made make_once(RehearsedTruth truth, Random& random) const {
    Hypothesis as = {arm_.nominal, arm_.effects};
    Made made;
    if (truth == RehearsedTruth::found) {
      as = d_.details->attribution.final_fit.hypothesis;
      made.effects.assign(as.effects.begin() + static_cast<std::ptrdiff_t>(n_given()), as.effects.end());
    } else if (truth == RehearsedTruth::drawn) {
      made.effects = draw_effects(random);
      as.effects.insert(as.effects.end(), made.effects.begin(), made.effects.end());
    }
    for (const LoggedMotion& motion : training_) made.training.push_back(motion.as_of(as, random));
    // What happens at an instant of the training happens in no other log.
    as.past.clear();
    std::erase_if(as.effects, [&](const PlacedEffect& e) { return has_instants(e, arm_.nominal); });
    if (holdout_) made.holdout = holdout_->as_of(as, random);
    return made;
  }

  std::vector<PlacedEffect> draw_effects(Random& random) const {
    std::vector<PlacedEffect> effects;
    for (std::size_t i = 0; i < std::clamp<std::size_t>(n_found(), 1, kMostDrawn); ++i) {
      std::vector<PlacedEffect> others = arm_.effects;
      others.insert(others.end(), effects.begin(), effects.end());
      std::optional<PlacedEffect> drawn = draw_effect(effects_to_draw(), arm_, others, nullptr, random);
      if (!drawn) break;
      draw_parameters(*drawn, arm_, range_, random);
      effects.push_back(*drawn);
    }
    return effects;
  }

  /// Of what was found, only names are to be found again.
  std::vector<HiddenEffect> hidden_of(const Made& made, RehearsedTruth truth, std::uint64_t seed) const {
    std::vector<HiddenEffect> hidden;
    if (truth == RehearsedTruth::found) {
      for (const NamedEffect& e : d_.effects) hidden.push_back({e.effect, true, false});
    } else if (truth == RehearsedTruth::drawn) {
      const std::vector<double> from = detected_from(arm_, without_effect(seed), made.effects);
      for (std::size_t i = 0; i < made.effects.size(); ++i) hidden.push_back({made.effects[i], from[i] <= 1, false});
    }
    return hidden;
  }

  /// The training logs as the arm without an effect would have given them.
  std::vector<Log> without_effect(std::uint64_t seed) const {
    Random random(seed, kWithoutEffect, 0);
    std::vector<Log> logs;
    for (const LoggedMotion& motion : training_) {
      Log log = motion.as_of({arm_.nominal, arm_.effects}, random);
      logs.push_back(holdout_ ? std::move(log) : split_log(log, kTrainingShare).first);
    }
    return logs;
  }

  std::vector<PlacedEffect> neither_right_nor_false(const RehearsedLog& log) const {
    std::vector<PlacedEffect> effects;
    for (const HiddenEffect& h : log.hidden)
      for (const std::string& name : names_of_parts(h.effect.effect->name()))
        effects.push_back({find_effect(name), h.effect.joint});
    if (log.truth == RehearsedTruth::found)  // effects without a name
      for (std::size_t i = n_given(); i < d_.revised.effects.size(); ++i) effects.push_back(d_.revised.effects[i]);
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

Rehearsal rehearse(const ArmModel& model, const Diagnosis& d, const std::vector<Log>& training,
                   const std::optional<Log>& holdout, const RehearsalOptions& options, const DiagnosisOptions& how,
                   const std::function<void(const std::string&, double)>& progress) {
  const Rehearser rehearser(model, d, training, holdout, how);
  Rehearsal rehearsal{options.seed, {}};
  for (int i = 0; i < options.logs; ++i) {
    if (progress) progress("rehearsals", static_cast<double>(i) / options.logs);
    rehearsal.logs.push_back(rehearser.run(options.seed, static_cast<std::uint32_t>(i)));
  }
  return rehearsal;
}

}  // namespace halyard
