#include "evaluation/json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace halyard {

using nlohmann::ordered_json;

ordered_json number_or_null(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr); }

ordered_json text_or_null(const std::string& text) { return text.empty() ? ordered_json(nullptr) : ordered_json(text); }

std::uint64_t whole_number(const ordered_json& json) { return json.get_ref<const ordered_json::number_unsigned_t&>(); }

std::string json_text(const ordered_json& json) {
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace halyard
