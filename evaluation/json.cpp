#include "evaluation/json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace halyard {

using nlohmann::ordered_json;

ordered_json number_or_null(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr); }

std::uint64_t whole_number(const ordered_json& json) {
  if (!json.is_number_unsigned()) throw std::invalid_argument("not a whole number");
  return json.get<std::uint64_t>();
}

std::string json_text(const ordered_json& json) {
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace halyard
