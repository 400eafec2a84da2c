#pragma once
/// How probable is it that a candidate is what the arm has, given the log? Candidates of one round compete with each
/// other and with "no effect", by their log-likelihood on blocks that no fit has used:
///
///   w_i = mean over draws d of  π_i exp(Σ_b B ω_db l_ib) / Σ_j π_j exp(Σ_b B ω_db l_jb)
///
///   l_ib   ln L of candidate i on deciding block b (likelihood.h)
///   ω_d    one draw of weights of the B blocks, Dirichlet(1, ..., 1): another log of the same arm
///   π_i    prior: exp(-(prior cost of the candidate, naming.h) - (that of the model's own numbers, judge.h))
///
/// Source: pseudo-BMA+ of Yao, Vehtari, Simpson, Gelman, Bayesian Analysis 13 (2018), section 3.4.
///
/// It is possible that no candidate is right. Then more residual is left in a channel than noise and the error in the
/// equation of the right effect can explain together:
///
///   ρ = MSE_after / (floor² + η² MSE_before)
///   P(none) = 1 / (1 + (ρ0 / ρ)^s)
///
///   MSE_before   mean square without the effect, all else equal     η   misfit_of() it, judge.h
///   ρ0, s        rest_ratio² and none_sharpness of decision_rule.h

#include "diagnosis/judgement/likelihood.h"

namespace halyard {

/// A candidate that competes for the name.
struct Competitor {
  const Likelihood* log_likelihood = nullptr;
  double prior_cost = 0;  ///< of the candidate and of its changes of the model's own numbers, nats
};

/// The weight of each competitor, then that of no effect; they sum to one. The draws have a fixed seed.
std::vector<double> name_weights(const Evidence& evidence, const std::vector<Competitor>& competitors,
                                 const Competitor& no_effect);

/// P(none) of one channel. misfit_square: η² MSE_before.
double probability_of_none(double mean_square_after, double misfit_square, double floor);

/// That the arm has no effect which the model lacks. no_effect: its weight after the last name. present: for each
/// effect that was found, with a name or without, what its name and the alternatives weigh against no effect.
double probability_of_clean(double none, double no_effect, const std::vector<double>& present);

/// probability: of each name. True for the names of the smallest set that holds the right name with `share` of the sum
/// of all these probabilities.
std::vector<bool> credible_set(const std::vector<double>& probability, double share);

}  // namespace halyard
