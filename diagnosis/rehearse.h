#pragma once
/// Rehearses a diagnosis: how often is it right on logs like this one? Logs are made with the motion, the sensors and
/// the noise of the real ones, but with effects that are known, and are diagnosed as the real ones were.
///
/// The arm of a rehearsal has the numbers that the diagnosis found. Of four rehearsals in a row
///
///   the first    has what the diagnosis found, with its parameters: would it be found again?
///   the second   has no effect that the given model lacks: is it clean?
///   two more     have effects drawn at random from the library, as many as the diagnosis found, at least one
///
/// Effects that act on the motors' commands (EffectStage::command) are not drawn: the motion is the logged one, and an
/// arm with them would have moved in another way. The rehearsed arm has the library's equations, so a rehearsal says
/// nothing about causes that are not in it.
///
///   right_if_certain = min(1, (Σ right + c n) / (Σ w + n))     over the names of all rehearsals but the first kind
///
///   right    1 of a right name, 0 of a false one
///   w        what the evidence said of it: its probability over c
///   c, n     DecisionRule::right_if_certain, and the number of names that it counts for here, 20
///
/// A name that is right of a part of an effect (of a friction that drifts, more friction) counts neither way.

#include <cstdint>

#include "diagnosis/diagnose.h"

namespace halyard {

struct RehearsalOptions {
  int logs = 20;           ///< number of rehearsals
  std::uint64_t seed = 1;  ///< of everything that is drawn
};

/// What the arm of a rehearsal has.
enum class RehearsedTruth { found, nothing, drawn };

/// An effect that the arm of a rehearsal had and the given model had not.
struct HiddenEffect {
  PlacedEffect effect;
  bool is_visible;  ///< detected_from() (plan.h): not below the detection limit
  bool is_named;
};

/// A name that a rehearsal gave.
struct RehearsedName {
  PlacedEffect effect;
  double probability;  ///< as told
  bool is_right;
};

struct RehearsedLog {
  RehearsedTruth truth = RehearsedTruth::nothing;
  std::vector<HiddenEffect> hidden = {};
  std::vector<RehearsedName> names = {};  ///< without those that count neither way
  Diagnosis::Verdict verdict = Diagnosis::Verdict::unknown;
  std::string failure = {};  ///< why it could not be made or diagnosed; empty: it was

  /// Each visible effect is named, and no name is false; without any effect: clean.
  bool is_right() const;
};

/// Rehearsals with one kind of truth. Those that failed are not right, and their effects not named.
struct RehearsalCount {
  int logs = 0, right = 0, failed = 0;
  int visible = 0, named = 0, too_small = 0;  ///< effects: visible, visible and named, not visible
  int names = 0, false_names = 0;
};

struct Rehearsal {
  std::uint64_t seed = 1;
  std::vector<RehearsedLog> logs;

  RehearsalCount count(RehearsedTruth truth) const;
  double right_if_certain() const;
  /// A probability that diagnose() told of a name, with right_if_certain() in place of DecisionRule's.
  double calibrated(double probability) const;
};

/// Arguments as those of diagnose(), and what it returned. progress(what, fraction) is never called by two threads at
/// once. Throws as diagnose() does.
Rehearsal rehearse(const ArmModel& model, const Diagnosis& diagnosis, const std::vector<Log>& training,
                   const std::optional<Log>& holdout, const RehearsalOptions& options, const DiagnosisOptions& how = {},
                   const std::function<void(const std::string&, double)>& progress = {});

}  // namespace halyard
