#pragma once
/// JSON as halyard writes it.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace halyard {

/// JSON has no NaN: it becomes null.
nlohmann::ordered_json number_or_null(double value);

/// Indented, with a last line break; bytes of paths that are no UTF-8 become U+FFFD.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace halyard
