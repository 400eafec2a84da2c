#include "diagnosis/judgement/name_probability.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "diagnosis/judgement/decision_rule.h"

namespace halyard {

std::vector<double> name_weights(const Evidence& evidence, const std::vector<Competitor>& competitors,
                                 const Competitor& no_effect) {
  constexpr int kDraws = 400;
  constexpr std::uint64_t kSeed = 1;
  std::vector<Competitor> all = competitors;
  all.push_back(no_effect);
  const auto& count = evidence.block_count();
  std::vector<std::size_t> blocks;
  for (std::size_t b = 0; b < count.size(); ++b)
    if (std::reduce(count[b].begin(), count[b].end()) > 0) blocks.push_back(b);

  std::mt19937_64 random(kSeed);
  std::vector<double> mean(all.size(), 0), weight(blocks.size()), score(all.size());
  for (int draw = 0; draw < kDraws; ++draw) {
    double sum = 0;
    for (double& w : weight) {
      w = -std::log1p(-std::generate_canonical<double, 53>(random));
      sum += w;
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      score[i] = -all[i].prior_cost;
      for (std::size_t b = 0; b < blocks.size(); ++b) {
        const std::vector<double>& ln = (*all[i].log_likelihood)[blocks[b]];
        score[i] += static_cast<double>(blocks.size()) * weight[b] / sum * std::reduce(ln.begin(), ln.end());
      }
    }
    const double most = *std::ranges::max_element(score);
    double total = 0;
    for (double& s : score) total += s = std::exp(s - most);
    for (std::size_t i = 0; i < all.size(); ++i) mean[i] += score[i] / total / kDraws;
  }
  return mean;
}

double probability_of_none(double mean_square_after, double misfit_square, double floor) {
  const double ratio = mean_square_after / (floor * floor + misfit_square);
  return ratio > 0 ? 1 / (1 + std::pow(kRule.rest_ratio * kRule.rest_ratio / ratio, kRule.none_sharpness)) : 0;
}

double probability_of_clean(double none, double no_effect, const std::vector<double>& present) {
  double absent = no_effect;
  for (const double p : present) absent = std::min(absent, 1 - p);
  return (1 - none) * std::max(absent, 0.0);
}

std::vector<bool> credible_set(const std::vector<double>& probability, double share) {
  std::vector<std::size_t> order(probability.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t i) { return probability[i]; });
  const double all = std::reduce(probability.begin(), probability.end());
  std::vector<bool> in(probability.size(), false);
  double sum = 0;
  for (const std::size_t i : order) {
    if (sum >= share * all) break;
    in[i] = true;
    sum += probability[i];
  }
  return in;
}

}  // namespace halyard
