#pragma once
/// The score of a hypothesis on the deciding blocks, and what of it two hypotheses have in common.
///
///   ln L_b = -1/2 Σ_c n_bc/m ln(MSE_bc + least_c²)
///
///   n_bc, MSE_bc   rows of channel c in block b, their mean square
///   m              rows that are worth one independent sample
///   least_c        below which residuals count alike: the channel's floor, at least
///
/// Each block has its own variance: no single block can carry or spoil a verdict.

#include "diagnosis/evidence.h"
#include "diagnosis/paired_t.h"

namespace halyard {

/// ln L, [deciding block][channel].
using Likelihood = std::vector<std::vector<double>>;

/// One addend of ln L_b. least_square: least_c².
double block_log_likelihood(const Evidence& evidence, double rows, double mean_square, double least_square);

/// least_square: [2n].
Likelihood log_likelihood(const Evidence& evidence, const Score& score, const std::vector<double>& least_square);

/// [2n] floor_c².
std::vector<double> squared_floors(const Evidence& evidence);

/// By how much one lies above the other in each deciding block that has rows.
Paired paired(const Evidence& evidence, const Likelihood& with, const Likelihood& without);

/// How much of what the lesser of two candidates gains, block by block and channel by channel, the other gains as well.
double shared_gain(const Likelihood& a, const Likelihood& b, const Likelihood& without);

}  // namespace halyard
