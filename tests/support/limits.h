#pragma once
/// Two numbers that many tests need.

#include <limits>

namespace halyard {

inline constexpr double kEps = std::numeric_limits<double>::epsilon();
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace halyard
