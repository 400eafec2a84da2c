#include "bench/performance/turns.h"

#include <algorithm>
#include <chrono>
#include <numeric>

#include "bench/bench_arm.h"
#include "model/statistics/quantile.h"

namespace halyard {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kBlock = 100;  // steps of a variant before it is the next one's turn

/// The middle one of means over blocks, which a few interruptions do not move.
double mean_of_blocks(const std::vector<double>& us) {
  std::vector<double> means;
  for (auto first = us.begin(); us.end() - first >= std::ptrdiff_t{kBlock}; first += kBlock)
    means.push_back(std::accumulate(first, first + kBlock, 0.0) / kBlock);
  return median(std::move(means));
}

StepTime summary(const std::string& name, const std::vector<double>& us) {
  return {name, mean_of_blocks(us), median(us), quantile(us, 0.99)};
}

}  // namespace

std::vector<StepTime> time_in_turns(const std::vector<Variant>& variants, std::size_t samples, int rounds) {
  std::vector<std::vector<double>> us(variants.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t first = 0; first < samples; first += kBlock)
      for (std::size_t v = 0; v < variants.size(); ++v)
        for (std::size_t i = first; i < std::min(first + kBlock, samples); ++i) {
          const Clock::time_point before = Clock::now();
          variants[v].step(i);
          us[v].push_back(std::chrono::duration<double, std::micro>(Clock::now() - before).count());
        }
  std::vector<StepTime> all;
  for (std::size_t v = 0; v < variants.size(); ++v) all.push_back(summary(variants[v].name, us[v]));
  return all;
}

std::vector<Sample> recorded(const ArmModel& model) {
  Scenario scenario = faster(sines(model, 2));
  scenario.camera = Camera{};
  return samples_of(simulate(scenario).measured);
}

}  // namespace halyard
