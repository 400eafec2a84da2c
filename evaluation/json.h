#pragma once
/// JSON as halyard writes it.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace halyard {

/// The number, or null for NaN, which JSON does not have.
nlohmann::ordered_json number_or_null(double value);

/// Indented text that ends with a line break. Bytes that are not UTF-8, as in paths, become U+FFFD.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace halyard
