#pragma once
/// How probable is it that a candidate is what the arm has, given the log? Candidates of one round compete with each
/// other and with "no effect", by their log-likelihood on blocks that no fit has used:
///
///   w_i = mean over draws d of  π_i exp(Σ_b B ω_db l_ib) / Σ_j π_j exp(Σ_b B ω_db l_jb)
///
///   l_ib   ln L of candidate i on deciding block b (likelihood.h)
///   ω_d    one draw of weights of the B blocks, Dirichlet(1, ..., 1): another log of the same arm
///   π_i    prior: exp(-numbers that the candidate adds)
///
/// Source: pseudo-BMA+ of Yao, Vehtari, Simpson, Gelman, Bayesian Analysis 13 (2018), section 3.4.
///
/// None of the candidates may be right. What is left in a channel then is larger than noise and the misfit of a right
/// name's functional form can explain:
///
///   ρ = max over channels of  MSE_after / (floor² + η² MSE_before)
///   P(none) = 1 / (1 + (ρ0 / ρ)^s)

#include "diagnosis/judgement/likelihood.h"

namespace halyard {

/// A candidate that competes for the name.
struct Competitor {
  const Likelihood* log_likelihood = nullptr;
  int numbers = 0;        ///< that it adds to the model
  double prior_cost = 0;  ///< nats by which it stretches the model's own numbers
};

/// [competitors], then that of no effect; they sum to one. The draws have a fixed seed.
std::vector<double> name_weights(const Evidence& evidence, const std::vector<Competitor>& competitors,
                                 const Competitor& no_effect);

/// P(none) of one channel.
double probability_of_none(double mean_square_after, double mean_square_before, double floor);

/// Of names with these probabilities: true for those of the smallest set that holds the right one with `share` of all
/// probability in the list.
std::vector<bool> credible_set(const std::vector<double>& probability, double share);

}  // namespace halyard
