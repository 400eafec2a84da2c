#pragma once
/// The revision of a model that follows a search: its effects and numbers, fitted on all training data, without what
/// these data do not determine.

#include <cstddef>
#include <vector>

#include "diagnosis/search/attribution.h"

namespace halyard {

/// Fits what was found on all training data (final_fit.h): final_fit, final_score and namings change.
///   - An effect that these data do not determine is dropped. So is a doubtful one that belongs to the log and not to
///     the arm, as a push at some instant does: it predicts nothing elsewhere.
///   - Two effects that are one become one (complementary.h). It keeps the surer of their names.
///   - If no effect is left and no number changed, the model's numbers are as given.
///
/// whole: an Evidence without deciding blocks. given: the model that is revised.
/// Returns the numbers of the model that changed, see changed_numbers().
std::vector<std::size_t> revise(const Evidence& evidence, const Evidence& whole, const ArmModel& given,
                                Attribution& found);

/// After a cause that the library lacks has been weighed (unlisted_causes.h): drops the doubtful events as revise()
/// does. changed: what revise() returned. Returns the numbers that changed by then.
std::vector<std::size_t> drop_doubtful_events(const Evidence& evidence, const Evidence& whole, const ArmModel& given,
                                              Attribution& found, std::vector<std::size_t> changed);

/// P(none) of what the effect of that index explains in the final fit (name_probability.h). Effects at one joint may
/// cancel each other for the most part, as a zero and a ratio that together imitate a bent characteristic. What such an
/// effect may miss is measured by what all added effects at its joint do together, if that is less than what it does
/// alone. P(none) is at least the weight of Naming::unlisted. given: number of effects that the model came with.
double probability_of_none_for(const Evidence& evidence, const Attribution& found, std::size_t given,
                               std::size_t effect);

/// P(none) of each channel by the residual that is left in it; 0 without a sensor. One half where a residual begins to
/// be told. misfit: mean_square_misfit() of effects that are there.
std::vector<double> probabilities_of_a_rest(const Evidence& evidence, const Score& score,
                                            const std::vector<double>& misfit);

/// For each added effect: probability_of_none_for(), but at least wrong_beside_a_rest (decision_rule.h) of what the
/// residual at its joint says, beside the misfit of all added effects.
std::vector<double> probabilities_of_none(const Evidence& evidence, const Attribution& found, std::size_t given);

/// True if it is more probable that the name of an effect and all its alternatives are wrong than that one of them is
/// right. none: probability that no name is.
bool is_doubtful(const Naming& naming, double none);

/// Why an effect gets no name.
enum class Doubt {
  none,
  another_cause,    ///< is_doubtful(), with probabilities_of_none()
  surer_rival,      ///< Naming::surer
  guess,            ///< its name is not sure enough beside others, see kRule.sure_name and kRule.worth_a_name
  no_certain_size,  ///< the intervals of all its sizes contain their neutral values
  only_beside_one   ///< not needed without the doubtful effects: it may only make up for their error
};

/// Completes "EFFECT explains a part of it, but ...". found: all effects that were found. none: probability that no
/// name is right.
std::string reason_of(Doubt doubt, const Naming& naming, double none, const std::vector<PlacedEffect>& found);

/// Of a revision that the hold-out refuses. added: its effects, with names and without; none: it has refitted numbers
/// alone.
std::string reason_of_refusal(const std::vector<PlacedEffect>& added);

/// For each added effect of the final fit. none: probabilities_of_none(). significance: as of the search.
std::vector<Doubt> doubts(const Evidence& evidence, const ArmModel& given, const Attribution& found,
                          const std::vector<double>& none, double significance);

}  // namespace halyard
