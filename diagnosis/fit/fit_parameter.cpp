#include "diagnosis/fit/fit_parameter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/drive_ratio.h"

namespace halyard {
namespace {

/// Step of a sensitivity, in units of the optimiser. It has to bridge the roughness of residuals with impacts: at 0.02
/// a half gap stayed where its search began.
constexpr double kStep = 0.1;

/// Unit of an instant, s: the step of its sensitivity is one sample of a record. A cable that slips makes its joint
/// vibrate, which is not linear in the instant beyond a fraction of a period.
constexpr double kInstantScale = RecordOptions{}.step_s / kStep;

/// Starts of a wave number so close that one of them is within a quarter of a period of the truth over the whole
/// motion: a fit finds its way no farther.
void start_at_every_half_period(FitParameter& f, double span) {
  constexpr int kMost = 200;
  const double spacing = std::max(std::numbers::pi / span, (f.upper - f.lower) / kMost);
  f.starts.clear();
  for (double start = f.lower; start <= f.upper; start += spacing) f.starts.push_back(start);
  f.scale = 0.1 * spacing;
}

/// The motion in which the parameter is an order; 0: it is none. rad | m
double motion_of_order(const SearchSpace& space, std::size_t index, const Evidence& evidence, int joint) {
  if (space.order_of_motor_torque != index && space.order_of_joint_position != index) return 0;
  const Span span = space.order_of_motor_torque == index ? evidence.motor_span(joint) : evidence.joint_span(joint);
  return std::max(span.last - span.first, 1e-9);
}

/// The lowest order with kFewestPeriods periods in that motion.
double least_order(double motion) { return kFewestPeriods * 2 * std::numbers::pi / motion; }

/// Raises the lower bound of an order so far that the motion contains kFewestPeriods periods, and drops lower starts.
void limit_period(FitParameter& f, const SearchSpace& space, std::size_t index, const Evidence& evidence, int joint) {
  const double motion = motion_of_order(space, index, evidence, joint);
  if (motion == 0) return;
  f.lower = std::min(std::max(f.lower, least_order(motion)), f.upper);
  std::erase_if(f.starts, [&](double start) { return start < f.lower; });
  if (f.starts.empty()) f.starts = {f.is_whole ? std::min(std::ceil(f.lower), f.upper) : f.lower};
  if (space.order_of_joint_position == index && !f.is_whole) start_at_every_half_period(f, motion);
}

/// Adds starts above the fastest motion, at which a torque that falls with speed reaches these shares of its value at
/// standstill. The motor's own friction is what it still has to overcome there: some hundredths to half of that torque.
void add_greatest_speeds(FitParameter& f, const SearchSpace& space, std::size_t index, const Evidence& evidence,
                         int joint) {
  if (space.greatest_motor_speed != index) return;
  for (const double share_left : {0.02, 0.06, 0.2, 0.5})
    f.starts.push_back(std::clamp(evidence.greatest_speed(joint) / (1 - share_left), f.lower, f.upper));
  std::ranges::sort(f.starts);
  f.starts.erase(std::unique(f.starts.begin(), f.starts.end()), f.starts.end());
}

/// Lowers the upper bound of a speed near standstill, and drops higher starts.
void limit_to_standstill(FitParameter& f, const ParameterSearch& search, const Evidence& evidence, int joint) {
  const double fastest = search.per_motor_speed * evidence.greatest_speed(joint);
  if (!(fastest > 0)) return;
  f.upper = std::clamp(kNearStandstill * fastest, f.lower, f.upper);
  std::erase_if(f.starts, [&](double start) { return start > f.upper; });
  if (f.starts.empty()) f.starts = {0.5 * (f.lower + f.upper)};
}

/// How far the starts of a search lie apart around a value: about as far as it finds its way.
double spacing_around(const std::vector<double>& starts, double value) {
  std::size_t i = 1;
  while (i + 1 < starts.size() && value > starts[i]) ++i;
  return starts[i] - starts[i - 1];
}

}  // namespace

double parameter_value(const Hypothesis& h, const FitParameter& p) {
  if (p.is_past) return h.past_state(*p.effect, p.index);
  if (p.effect) return h.effects[*p.effect].p[p.index];
  return named_value(h.nominal, p.index);
}

void set_parameter(Hypothesis& h, const FitParameter& p, double value) {
  if (p.is_past) h.set_past_state(*p.effect, p.index, value);
  else if (p.effect) h.effects[*p.effect].p[p.index] = value;
  else named_number(h.nominal, p.index).set(value);
}

Hypothesis stepped(const Hypothesis& h, const FitParameter& p) {
  Hypothesis m = h;
  const double value = parameter_value(h, p) + kStep * p.scale;
  set_parameter(m, p, value > p.upper ? value - 2 * kStep * p.scale : value);
  return m;
}

std::vector<FitParameter> baseline_parameters(const ArmModel& model) {
  ArmParameters<double> arm = model.nominal;
  std::vector<FitParameter> all;
  const auto named = named_parameters(arm);
  for (std::size_t i = 0; i < named.size(); ++i) {
    const double value = named[i].number.get(), reach = reach_with_one_ratio(model, named[i]);
    if (!(reach > 0)) continue;
    all.push_back({named[i].name, named[i].unit, std::nullopt, i, value, std::max(value - reach, named[i].least),
                   value + reach, reach / 2, true});
  }
  return all;
}

std::vector<FitParameter> effect_parameters(const Evidence& evidence, const Hypothesis& h,
                                            const ArmParameters<double>& nominal, std::size_t place) {
  const PlacedEffect& e = h.effects[place];
  std::vector<FitParameter> all;
  const auto parameters = e.effect->parameters(nominal, e.joint);
  const SearchSpace space = search_space(*e.effect, nominal, e.joint);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const EffectParameter& p = parameters[i];
    const ParameterSearch& search = space.parameters[i];
    FitParameter f{p.name, p.unit, place, i, p.neutral, p.lower, p.upper, 1, search.natural_bounds};
    f.scale = std::max({std::abs(p.typical - p.neutral), 0.1 * std::abs(p.typical), 1e-3 * (p.upper - p.lower)});
    f.shape = p.is_shape();
    f.starts = search.starts;
    add_greatest_speeds(f, space, i, evidence, e.joint.value_or(0));
    limit_to_standstill(f, search, evidence, e.joint.value_or(0));
    if (f.shape && f.starts.size() > 1) f.scale = 0.1 * spacing_around(f.starts, e.p[i]);
    f.range = search.range;
    f.is_whole = search.is_whole;
    f.is_wall = search.is_wall;
    if (search.another_at) f.another_at = std::clamp(*search.another_at, p.lower, p.upper);
    limit_period(f, space, i, evidence, e.joint.value_or(0));
    if (f.is_whole) f.lower = std::ceil(f.lower), f.upper = std::floor(f.upper);
    if (search.range != SearchRange::own) {
      const Span span =
          search.range == SearchRange::record_time ? evidence.time_span() : evidence.joint_span(e.joint.value_or(0));
      f.lower = span.first;
      f.upper = span.last;
      f.scale =
          search.range == SearchRange::record_time ? kInstantScale : std::max(0.01 * (span.last - span.first), 1e-9);
    }
    all.push_back(f);
  }
  constexpr std::size_t kMostRecords = 12;
  constexpr double kFar = 5;  // times a state's size, which may grow while it is fitted
  if (evidence.records().size() > kMostRecords) return all;
  for (std::size_t r = 0, i = 0; r < evidence.records().size(); ++r)
    for (const double scale : e.effect->state_scale(nominal, e.joint, e.p)) {
      FitParameter f{
          "past of record " + std::to_string(r + 1), "", place, i++, 0, -kFar * scale, kFar * scale, scale, true};
      f.shape = f.is_past = true;
      f.starts = {-1, 0, 1};
      all.push_back(f);
    }
  return all;
}

bool has_enough_periods(const Evidence& evidence, const PlacedEffect& effect, const ArmParameters<double>& nominal) {
  const auto parameters = effect.effect->parameters(nominal, effect.joint);
  const SearchSpace space = search_space(*effect.effect, nominal, effect.joint);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double motion = motion_of_order(space, i, evidence, effect.joint.value_or(0));
    if (motion > 0 && least_order(motion) > parameters[i].upper) return false;
  }
  if (!space.period_of_motor) return true;
  const Span span = evidence.motor_span(effect.joint.value_or(0));
  return span.last - span.first >= kFewestPeriods * *space.period_of_motor;
}

std::vector<FitParameter> without_parameters_of(std::vector<FitParameter> parameters, std::size_t gone) {
  std::erase_if(parameters, [&](const FitParameter& p) { return p.effect == gone; });
  for (FitParameter& p : parameters)
    if (p.effect > gone) --*p.effect;
  return parameters;
}

std::vector<ParameterGroup> groups_of(const std::vector<FitParameter>& parameters) {
  std::vector<ParameterGroup> groups;
  std::optional<std::size_t> effect;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const FitParameter& p = parameters[i];
    if (!p.effect) continue;
    if (p.effect != effect || (!p.shape && !groups.back().shapes.empty())) groups.emplace_back();
    effect = p.effect;
    (p.shape ? groups.back().shapes : groups.back().sizes).push_back(i);
  }
  return groups;
}

std::vector<FitParameter> instants_of(const std::vector<FitParameter>& parameters, const ParameterGroup& group) {
  std::vector<FitParameter> instants;
  for (const std::size_t i : group.shapes)
    if (parameters[i].range == SearchRange::record_time) instants.push_back(parameters[i]);
  return instants;
}

bool is_at_bound(const FitParameter& p, double value) {
  if (!p.effect) {
    constexpr double kPressed = 0.95;  // of the tolerance
    const double off = value - p.nominal;
    return off > kPressed * (p.upper - p.nominal) || off < kPressed * (p.lower - p.nominal);
  }
  const auto near = [&](double bound) { return 1e-3 * std::max(std::abs(bound), 1e-3 * p.scale); };
  return !p.is_whole && std::abs(value - p.nominal) > near(p.nominal) &&
         (value <= p.lower + near(p.lower) || value >= p.upper - near(p.upper));
}

bool is_at_limit(const FitParameter& p, double value) {
  if (!is_at_bound(p, value)) return false;
  if (p.effect) return p.natural_bounds;
  constexpr double kRounding = 1e-9;  // of the tolerance
  const double below = p.nominal - p.lower, above = p.upper - p.nominal;
  return value < p.nominal && below < (1 - kRounding) * above;
}

bool ends_at_bound(const FitParameter& p, double value) {
  return p.effect && !p.natural_bounds && is_at_bound(p, value);
}

bool effect_changes(const PlacedEffect& effect, const ArmParameters<double>& nominal, const FitParameter& baseline) {
  PlacedEffect e = effect;
  const auto parameters = e.effect->parameters(nominal, e.joint);
  for (std::size_t i = 0; i < parameters.size(); ++i)
    e.p[i] = parameters[i].neutral + 0.1 * (parameters[i].upper - parameters[i].neutral);
  Hypothesis before{nominal, {}}, after{nominal, {}};
  e.effect->change_parameters(after.nominal, e.joint, e.p);
  return parameter_value(before, baseline) != parameter_value(after, baseline);
}

bool effect_covers(const PlacedEffect& effect, const ArmParameters<double>& nominal, const FitParameter& baseline) {
  return effect_changes(effect, nominal, baseline) && !search_space(*effect.effect, nominal, effect.joint).numbers_stay;
}

}  // namespace halyard
