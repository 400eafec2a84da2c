#pragma once
/// JSON as halyard writes it.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace halyard {

/// The number, or null for NaN, which JSON does not have.
nlohmann::ordered_json number_or_null(double value);
/// The text, or null for an empty one.
nlohmann::ordered_json text_or_null(const std::string& text);

/// Throws the library's exception for anything but a whole number that is not negative. Its get() would convert a
/// fraction or a larger number, which is undefined where the integer cannot hold it.
std::uint64_t whole_number(const nlohmann::ordered_json& json);

/// Indented text that ends with a line break. Bytes that are not UTF-8, as in paths, become U+FFFD.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace halyard
