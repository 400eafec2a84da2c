#pragma once
/// Samples of the unit cube [0, 1)^d for studies of many parameters at once. A grid of d axes with m values needs m^d
/// points; samples cover each axis evenly with any number of points.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace halyard {

/// One axis' coordinates of all samples: [d][n].
using UnitSamples = std::vector<std::vector<double>>;

/// Latin hypercube (McKay, Beckman and Conover, Technometrics 21, 1979): each axis is divided into n equal intervals,
/// and each interval has one sample, at a random place.
UnitSamples latin_hypercube(std::size_t dimension, std::size_t samples, std::uint64_t seed);

/// The first n points of Sobol's sequence, which fills the cube more evenly than random numbers do, with Joe and Kuo's
/// direction numbers (SIAM J. Sci. Comput. 30, 2008; Boost.Random). Boost leaves out the origin, so 2^k - 1 points are
/// the most even.
UnitSamples sobol_sequence(std::size_t dimension, std::size_t samples);

}  // namespace halyard
