#pragma once
/// What the library says of the parameters of its effects.

#include <string>

namespace halyard::blind {

struct ListedParameter {
  double neutral = 0;     ///< value without an effect; of a shape that differs between joints, one of these
  bool is_whole = false;  ///< a number such as an order, which a diagnosis gives no interval
};

/// By the names of effect and parameter, as the RAVEN-II has them. Of one that it does not have: the defaults.
ListedParameter listed_parameter(const std::string& effect, const std::string& parameter);

}  // namespace halyard::blind
