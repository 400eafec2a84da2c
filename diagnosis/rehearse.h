#pragma once
/// Rehearses a diagnosis: how often is it right on logs like this one? Logs are made with the motion, the sensors and
/// the noise of the real ones, but with effects that are known, and are diagnosed as the real ones were.
///
/// The arm of a rehearsal has the numbers that the diagnosis found. Of four rehearsals in a row
///
///   the first    has what the diagnosis found, with its parameters; no effect if the diagnosis gave no name
///   the second   has no effect that the given model lacks
///   two more     have effects drawn at random from the library: as many as the diagnosis found, one to three
///
/// Effects that act on the motors' commands (EffectStage::command) are not drawn: the motion is the logged one, and an
/// arm with them would have moved in another way. The rehearsed arm has the library's equations, and the errors of the
/// found model's form no longer go with the motion. So rehearsals say nothing about other forms and other causes, and
/// can only lower a probability:
///
///   right_if_certain = min(c, (right + c n) / (all + n))
///
///   all, right   names for which the evidence had more than 0.9, of all rehearsals but the first kind; those of them
///                that are right
///   c, n         DecisionRule::right_if_certain, and the number of names that it counts for here, 20
///
/// A name that is right of a part of an effect (of a friction that drifts, more friction) counts neither way; nor does
/// one that is right about a number of the arm beyond its tolerance.

#include <cstdint>

#include "diagnosis/diagnose.h"

namespace halyard {

struct RehearsalOptions {
  int count = 20;          ///< number of rehearsals
  std::uint64_t seed = 1;  ///< of everything that is drawn
};

/// What the arm of a rehearsal has.
enum class RehearsedTruth { found, nothing, drawn };

/// An effect that the arm of a rehearsal had and the given model had not.
struct HiddenEffect {
  PlacedEffect effect;
  bool is_visible;  ///< not below the detection limit (detected_from() in plan.h, where every log has its events)
  bool is_named;
};

/// A name that a rehearsal gave.
struct RehearsedName {
  PlacedEffect effect;
  double probability;  ///< as told
  bool is_right;
};

struct Rehearsal {
  RehearsedTruth truth = RehearsedTruth::nothing;
  std::vector<HiddenEffect> hidden = {};
  std::vector<RehearsedName> names = {};  ///< without those that count neither way
  Diagnosis::Verdict verdict = Diagnosis::Verdict::unknown;
  std::vector<Unexplained> unexplained = {};
  std::string failure = {};  ///< why it could not be made or diagnosed; empty: it was

  /// Each visible effect is named, and no name is false; without any effect: clean.
  bool is_right() const;
};

/// Rehearsals with one kind of truth. Those that failed are not right, and their effects not named.
struct RehearsalCount {
  int rehearsals = 0, right = 0, failed = 0;
  int visible = 0, named = 0, too_small = 0;  ///< effects: visible, visible and named, not visible
  int names = 0, false_names = 0;
};

struct Rehearsals {
  std::uint64_t seed = 1;
  std::vector<Rehearsal> all;

  RehearsalCount count(RehearsedTruth truth) const;
  double right_if_certain() const;
  /// A probability that diagnose() told of a name, with right_if_certain() in place of DecisionRule's.
  double calibrated(double probability) const;
};

/// Arguments as those of diagnose(), and what it returned; each log has a source of its own. progress(what, fraction)
/// is never called by two threads at once. Throws as diagnose() does.
Rehearsals rehearse(const ArmModel& model, const Diagnosis& diagnosis, const std::vector<Log>& training,
                    const std::optional<Log>& holdout, const RehearsalOptions& options,
                    const DiagnosisOptions& how = {},
                    const std::function<void(const std::string&, double)>& progress = {});

}  // namespace halyard
