#include "diagnosis/judgement/likelihood.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace halyard {

double block_log_likelihood(const Evidence& evidence, int c, double rows, double mean_square, double least_square) {
  return -0.5 * rows / evidence.correlated_rows(c) * std::log(mean_square + least_square);
}

Likelihood log_likelihood(const Evidence& evidence, const Score& score, const std::vector<double>& least_square) {
  const auto& count = evidence.block_count();
  Likelihood ln(count.size(), std::vector<double>(evidence.channels(), 0));
  for (std::size_t b = 0; b < count.size(); ++b)
    for (int c = 0; c < evidence.channels(); ++c)
      if (count[b][c] > 0)
        ln[b][c] = block_log_likelihood(evidence, c, count[b][c], score.block_sum[b][c] / count[b][c], least_square[c]);
  return ln;
}

std::vector<double> squared_floors(const Evidence& evidence) {
  std::vector<double> squares;
  for (const double floor : evidence.floor()) squares.push_back(floor * floor);
  return squares;
}

Paired paired(const Evidence& evidence, const Likelihood& with, const Likelihood& without) {
  std::vector<double> differences;
  for (std::size_t b = 0; b < with.size(); ++b) {
    const auto total = [](const auto& all) { return std::reduce(all.begin(), all.end()); };
    if (total(evidence.block_count()[b]) > 0) differences.push_back(total(with[b]) - total(without[b]));
  }
  return paired(differences);
}

double log_likelihood_gain(const Evidence& evidence, const Score& with, const Score& without) {
  const std::vector<double> least = squared_floors(evidence);
  return paired(evidence, log_likelihood(evidence, with, least), log_likelihood(evidence, without, least)).sum;
}

double shared_gain(const Likelihood& a, const Likelihood& b, const Likelihood& without) {
  double of_a = 0, of_b = 0, of_both = 0;
  for (std::size_t i = 0; i < without.size(); ++i)
    for (std::size_t c = 0; c < without[i].size(); ++c) {
      const double gain_a = std::max(0.0, a[i][c] - without[i][c]), gain_b = std::max(0.0, b[i][c] - without[i][c]);
      of_a += gain_a, of_b += gain_b, of_both += std::min(gain_a, gain_b);
    }
  return of_both / std::max(std::min(of_a, of_b), 1e-300);
}

}  // namespace halyard
