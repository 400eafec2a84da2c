#pragma once
/// The log-likelihood of a hypothesis on the deciding blocks, and the gain that two hypotheses share.
///
///   ln L_b = -1/2 Σ_c n_bc/m_c ln(MSE_bc + least_c²)
///
///   n_bc, MSE_bc   rows of channel c in block b, their mean square
///   m_c            rows of the channel that equal one independent sample
///   least_c        residuals below it are treated as equal: at least the channel's floor
///
/// Each block has its own variance, so that no single block can dominate the result.

#include "diagnosis/fit/evidence.h"
#include "diagnosis/judgement/paired_t.h"

namespace halyard {

/// ln L, [deciding block][channel].
using Likelihood = std::vector<std::vector<double>>;

/// One term of ln L_b, of channel c. least_square: least_c².
double block_log_likelihood(const Evidence& evidence, int c, double rows, double mean_square, double least_square);

/// least_square: [2n].
Likelihood log_likelihood(const Evidence& evidence, const Score& score, const std::vector<double>& least_square);

/// [2n] floor_c².
std::vector<double> squared_floors(const Evidence& evidence);

/// The paired differences with - without over the deciding blocks that have rows.
Paired paired(const Evidence& evidence, const Likelihood& with, const Likelihood& without);

/// Σ_b (ln L_b with - ln L_b without), with least_c the channel's floor.
double log_likelihood_gain(const Evidence& evidence, const Score& with, const Score& without);

/// The gain that two candidates have in the same blocks and channels, as a fraction of the smaller of their two gains.
double shared_gain(const Likelihood& a, const Likelihood& b, const Likelihood& without);

}  // namespace halyard
