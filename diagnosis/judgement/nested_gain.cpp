#include "diagnosis/judgement/nested_gain.h"

#include <numeric>

#include "diagnosis/judgement/judge.h"

namespace halyard {

std::vector<double> nested_gains(const Evidence& evidence, const Score& with, const Score& without,
                                 const std::vector<double>& least_square) {
  const std::vector<double> change = difference(without.deciding, with.deciding);
  const auto common = evidence.block_products(without.deciding, change), own = evidence.block_products(change, change);
  const auto& count = evidence.block_count();
  std::vector<double> gains;
  for (std::size_t b = 0; b < count.size(); ++b) {
    if (std::reduce(count[b].begin(), count[b].end()) == 0) continue;
    double gain = 0;
    for (int c = 0; c < evidence.channels(); ++c)
      if (count[b][c] > 0)
        gain += count[b][c] / evidence.correlated_rows(c) * 2 * common[b][c] /
                (without.block_sum[b][c] + own[b][c] + count[b][c] * least_square[c]);
    gains.push_back(gain);
  }
  return gains;
}

}  // namespace halyard
