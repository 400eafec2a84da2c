#include "evaluation/sweep/parameters/estimator_option.h"

#include <algorithm>
#include <cctype>

#include "model/input/cell_text.h"
#include "model/input_error.h"
#include "model/xml/xml_reader.h"

namespace halyard {
namespace {

/// What may be the name of an attribute.
bool is_option_name(std::string_view name) {
  return !name.empty() && !std::isdigit(static_cast<unsigned char>(name[0])) &&
         std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

}  // namespace

std::optional<EstimatorOptionKey> parse_option_key(std::string_view key) {
  constexpr std::string_view kStart = "estimator.";
  if (!key.starts_with(kStart)) return std::nullopt;
  const std::string_view rest = key.substr(kStart.size());
  const std::size_t dot = rest.find('.');
  if (dot == rest.npos || dot == 0 || !is_option_name(rest.substr(dot + 1)))
    throw InputError("parameter " + in_quotes(key) +
                     ": expected estimator.NAME.OPTION, such as estimator.sr_ukf.torque_noise");
  return EstimatorOptionKey{std::string(rest.substr(0, dot)), std::string(rest.substr(dot + 1))};
}

std::optional<double> option_number(const ArmModel& model, const EstimatorOptionKey& key) {
  const auto options = model.estimators.find(key.estimator);
  if (options == model.estimators.end()) return std::nullopt;
  const auto option = options->second.find(key.option);
  if (option == options->second.end()) return std::nullopt;
  return parse_number(trim(option->second));
}

void set_option(ArmModel& model, const EstimatorOptionKey& key, double value) {
  model.estimators[key.estimator][key.option] = exact_text(value);
}

}  // namespace halyard
