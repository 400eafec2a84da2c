#pragma once
/// Random numbers that are the same with every standard library: the engine is specified by the standard, its
/// distributions are not.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace halyard {

class Random {
 public:
  /// Streams of different seeds, situations or trials have nothing in common.
  Random(std::uint64_t seed, std::uint32_t situation, std::uint32_t trial) {
    std::seed_seq words{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32), situation, trial};
    engine_.seed(words);
  }

  double uniform(double from, double to) { return from + (to - from) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  /// Both above 0.
  double log_uniform(double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); }
  /// Of mean 0 and variance 1; Box and Muller.
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform(0, 1)));
    return radius * std::cos(2 * std::numbers::pi * uniform(0, 1));
  }
  bool chance(double probability) { return uniform(0, 1) < probability; }
  /// 0 to count - 1.
  int below(int count) { return static_cast<int>(uniform(0, count)); }
  template <class T>
  const T& one_of(const std::vector<T>& all) {
    return all[below(static_cast<int>(all.size()))];
  }
  std::uint64_t seed() { return engine_(); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace halyard
