#pragma once
/// Whether a diagnosis is right, name by name and trial by trial.
///
/// Each name is compared with the truth once: a second name for the same effect is false. A name in
/// Result::also_true is neither right nor false.
///
///   kind                  strictly right                                 loosely right
///   clean                 verdict clean                                  no false name
///   effect, form          the truth is the first name, no other name is  the truth is the first name, or among at
///                         false, nothing is left unexplained             most two alternatives to it
///   two_at_joint, three   all visible effects are named, no name is      all visible effects are named
///                         false, nothing is left unexplained
///   outside               verdict unknown, no name with a probability    verdict unknown, or an unexplained residual
///                         above 0.5                                      beside the names
///
/// Effects that are too small to be seen (TrueEffect::is_visible()) may be named or not.

#include "bench/diagnosis/results/result.h"

namespace halyard::blind {

enum class NameScore { right, also_true, false_name };

/// For each of Result::named.
std::vector<NameScore> score_names(const Result& r);
/// Effects of the truth that no name is right about.
std::vector<Place> truth_without_name(const Result& r);
/// For each of Result::named: its set contains the truth. The name is not false, or an alternative in the set is an
/// effect of the truth without a name. Such an effect counts for one set.
std::vector<bool> sets_with_truth(const Result& r);
bool is_right(const Result& r, const Place& named);
/// The effect of the truth is among the names.
bool is_named(const Result& r, const TrueEffect& truth);
/// It is, or is an alternative to one of them.
bool is_named_or_alternative(const Result& r, const TrueEffect& truth);
int false_names(const Result& r);

bool strictly_right(const Result& r);
bool loosely_right(const Result& r);
/// There is a truth, and no effect of it is visible.
bool is_too_small(const Result& r);
/// The diagnosis says that a residual is left: unknown, or effects and an unexplained residual.
bool admits_rest(const Result& r);

}  // namespace halyard::blind
