#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace halyard {

/// Splits a list such as "kinematics, sr_ukf,./mine.so" at the commas. Throws InputError for an empty name or one given
/// twice.
std::vector<std::string> split_estimators(std::string_view text);

}  // namespace halyard
