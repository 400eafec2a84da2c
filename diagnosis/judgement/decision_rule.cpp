#include "diagnosis/judgement/decision_rule.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <variant>

namespace halyard {
namespace {

constinit DecisionRule rule_in_force;

struct Threshold {
  std::string_view name;
  std::variant<double DecisionRule::*, int DecisionRule::*, std::size_t DecisionRule::*> member;
};

constexpr Threshold kThresholds[] = {
    {"share", &DecisionRule::share},
    {"form_misfit", &DecisionRule::form_misfit},
    {"number_misfit", &DecisionRule::number_misfit},
    {"relief", &DecisionRule::relief},
    {"above_floor", &DecisionRule::above_floor},
    {"by_chance", &DecisionRule::by_chance},
    {"at_bound", &DecisionRule::at_bound},
    {"worth_a_fit", &DecisionRule::worth_a_fit},
    {"essential_level", &DecisionRule::essential_level},
    {"worth_a_change", &DecisionRule::worth_a_change},
    {"sets_kept", &DecisionRule::sets_kept},
    {"rest_ratio", &DecisionRule::rest_ratio},
    {"next_to_none", &DecisionRule::next_to_none},
    {"explained_ratio", &DecisionRule::explained_ratio},
    {"tell_apart", &DecisionRule::tell_apart},
    {"shared_gain", &DecisionRule::shared_gain},
    {"cost_of_effect", &DecisionRule::cost_of_effect},
    {"cost_of_number", &DecisionRule::cost_of_number},
    {"cost_of_a_limit", &DecisionRule::cost_of_a_limit},
    {"none_sharpness", &DecisionRule::none_sharpness},
    {"wrong_beside_a_rest", &DecisionRule::wrong_beside_a_rest},
    {"right_if_certain", &DecisionRule::right_if_certain},
    {"outside_if_certain", &DecisionRule::outside_if_certain},
    {"worth_a_name", &DecisionRule::worth_a_name},
    {"sure_name", &DecisionRule::sure_name},
    {"set_share", &DecisionRule::set_share},
    {"unusual_deviations", &DecisionRule::unusual_deviations},
    {"cost_of_wider_tolerances", &DecisionRule::cost_of_wider_tolerances},
    {"certainly_needed", &DecisionRule::certainly_needed},
    {"widest_tolerances", &DecisionRule::widest_tolerances},
    {"promise", &DecisionRule::promise},
    {"promise_of_channel", &DecisionRule::promise_of_channel},
    {"most_fitted", &DecisionRule::most_fitted},
    {"starts_fitted", &DecisionRule::starts_fitted},
    {"starts_fitted_beside_another", &DecisionRule::starts_fitted_beside_another},
    {"leaders", &DecisionRule::leaders},
    {"leaders_by_rest", &DecisionRule::leaders_by_rest},
    {"leads", &DecisionRule::leads},
    {"rivals", &DecisionRule::rivals},
    {"worth_a_nudge", &DecisionRule::worth_a_nudge},
    {"first_passes", &DecisionRule::first_passes},
    {"most_passes", &DecisionRule::most_passes},
    {"still_leads", &DecisionRule::still_leads},
};

constexpr std::size_t size_of_all() {
  std::size_t sum = 0;
  for (const Threshold& t : kThresholds)
    sum += std::visit([](auto member) { return sizeof(DecisionRule{}.*member); }, t.member);
  return sum;
}
static_assert(size_of_all() == sizeof(DecisionRule), "the list lacks a threshold, or has one twice");

}  // namespace

constinit const DecisionRule& kRule = rule_in_force;

void vary_rule(const std::string& name, double value) {
  const auto its = std::ranges::find(kThresholds, name, &Threshold::name);
  if (its == std::end(kThresholds))
    throw std::invalid_argument(fmt::format("there is no threshold {}; see diagnosis/judgement/decision_rule.h", name));
  constexpr double kMost = 1e6;
  if (!(value >= 0 && value <= kMost))
    throw std::invalid_argument(fmt::format("{} = {}: expected a number from 0 to {}", name, value, kMost));
  std::visit(
      [&]<class T>(T DecisionRule::*member) {
        if (std::is_integral_v<T> && (value != std::floor(value) || value < 1))
          throw std::invalid_argument(fmt::format("{} = {}: expected a whole number of at least 1", name, value));
        rule_in_force.*member = static_cast<T>(value);
      },
      its->member);
}

}  // namespace halyard
