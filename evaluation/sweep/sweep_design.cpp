#include "evaluation/sweep/sweep_design.h"

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/sobol.hpp>
#include <boost/random/uniform_01.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <numeric>
#include <utility>

namespace halyard {

// The distributions are Boost's: those of the standard library differ from one library to another.
UnitSamples latin_hypercube(std::size_t dimension, std::size_t samples, std::uint64_t seed) {
  boost::random::mt19937_64 random(seed);
  UnitSamples result(dimension, std::vector<double>(samples));
  for (std::vector<double>& axis : result) {
    std::iota(axis.begin(), axis.end(), 0.0);
    for (std::size_t i = samples; i-- > 1;)
      std::swap(axis[i], axis[boost::random::uniform_int_distribution<std::size_t>(0, i)(random)]);
    for (double& x : axis) x = (x + boost::random::uniform_01<double>()(random)) / double(samples);
  }
  return result;
}

UnitSamples sobol_sequence(std::size_t dimension, std::size_t samples) {
  boost::random::sobol sequence(dimension);
  const double range = double(sequence.max() - sequence.min()) + 1;
  UnitSamples result(dimension, std::vector<double>(samples));
  for (std::size_t i = 0; i < samples; ++i)
    for (std::vector<double>& axis : result) axis[i] = double(sequence() - sequence.min()) / range;
  return result;
}

}  // namespace halyard
