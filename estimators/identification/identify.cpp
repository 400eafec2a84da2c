#include "estimators/identification/identify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "estimators/identification/batch_estimate.h"
#include "estimators/identification/filter_run.h"
#include "model/input_error.h"
#include "model/statistics/distributions.h"

namespace halyard {
namespace {

constexpr double kShortest = 3;  // s of a log
constexpr double kTraceRows = 1000;
constexpr double kExcited = 0.5;  // of the prior's deviation: what was learnt is worth telling
constexpr double kChance = 3;     // standard deviations
constexpr double kDeviating = 2;  // tolerances: with too much process noise a cable's damping was up to 1.6 too large
constexpr double kMatters = 0.1;  // of a tolerance: a drift by less is none

void check_logs(const ArmModel& model, const std::vector<Log>& logs, const std::vector<std::string>& keys) {
  ArmParameters<double> arm = model.nominal;
  for (const ParameterInfo& info : named_parameters(arm)) {
    if (std::ranges::find(keys, info.key) == keys.end()) continue;
    for (const Log& log : logs)
      if (!log.has_joint_position(info.joint))
        throw InputError(fmt::format(
            "{}: column joint_position_{} is missing, or empty; {} cannot be told without that joint's sensor: give a "
            "log that has it, or say which column it is by --column joint_position_{}=COLUMN",
            log.source, info.joint + 1, info.name, info.joint + 1));
  }
  for (const Log& log : logs)
    if (log.duration() < kShortest)
      throw InputError(
          fmt::format("{}: {:.4g} s of it are for the estimation, without what is held out; expected at least {:g} s, "
                      "and more is better: give a longer log, or one of its own to hold out",
                      log.source, log.duration(), kShortest));
  if (logs.size() > 1 && has_unknown_zeros(model))
    throw InputError(
        fmt::format("{}: its encoders have a zero of their own in each log; give one log, or write their "
                    "offsets into the model",
                    model.source));
}

/// The first row of the trace's last third.
std::size_t last_third(const std::vector<double>& time) {
  return static_cast<std::size_t>(std::ranges::lower_bound(time, 2.0 / 3 * time.back()) - time.begin());
}

/// deviation: of the estimate, in prior deviations; own: the filter's own at the last third's start, in SI.
Convergence convergence_of(const IdentifiedNumber& number, double deviation, double reach, double own,
                           std::size_t from) {
  if (deviation > kExcited) return Convergence::not_excited;
  const double moved = std::abs(number.trace.back() - number.trace[from]);
  const bool matters = moved > kMatters * reach;
  return matters && moved > kChance * own ? Convergence::drifting : Convergence::converged;
}

/// What the dual filter believed over the logs, and at their end.
struct FilterTrace {
  std::vector<double> time;
  std::vector<Eigen::VectorXd> u, deviation;
  Eigen::VectorXd last_u, last_deviation;  ///< u is that of the model if the filter failed
  std::string failure;                     ///< empty: none
};

FilterTrace run_dual_filter(const ArmModel& model, const Unknowns& unknowns, const std::vector<Log>& logs,
                            double disturbances, const std::function<void(double)>& progress) {
  FilterTrace trace;
  DualUkf filter(model, unknowns.learnt_weights(), {.disturbances = disturbances});
  const double row_span = duration_of(logs) / kTraceRows;
  double next = 0;
  try {
    run_filter(filter, logs, progress, [&](const DualStep&, double time) {
      if (time < next) return;
      next += row_span;
      trace.time.push_back(time);
      trace.u.push_back(filter.w());
      trace.deviation.emplace_back(filter.S_w().rowwise().norm());
    });
    trace.last_u = filter.w();
    trace.last_deviation = filter.S_w().rowwise().norm();
  } catch (const std::runtime_error& e) {
    if (trace.time.empty()) throw;
    trace.failure = e.what();
    trace.last_u = Eigen::VectorXd::Zero(unknowns.learnt);
    trace.last_deviation = trace.deviation.back();
  }
  return trace;
}

/// The i-th of the numbers asked for, but for what named_parameters() says of it.
void tell_number(const Unknowns& unknowns, Eigen::Index i, const JackknifeEstimate& estimate, const FilterTrace& trace,
                 IdentifiedNumber& number) {
  const Weight& weight = unknowns.weights[i];
  const double u = estimate.u(i), reach = t_quantile(std::max(1, estimate.blocks - 1), 0.025) * estimate.deviation(i);
  number.value = weight.value(u);
  number.lower = weight.value(u - reach);
  number.upper = weight.value(u + reach);
  const double widened = estimate.deviation(i) / trace.last_deviation(i);
  for (std::size_t r = 0; r < trace.u.size(); ++r) {
    number.trace.push_back(weight.value(trace.u[r](i)));
    // What was known before is as wide as it is: only what was learnt is widened.
    const double own = std::min(1.0, trace.deviation[r](i));
    number.trace_std.push_back(std::abs(weight.slope(trace.u[r](i))) * own * (own * own + (1 - own * own) * widened));
  }
  const std::size_t from = last_third(trace.time);
  const double own = std::abs(weight.slope(trace.u[from](i))) * trace.deviation[from](i);
  number.convergence = convergence_of(number, estimate.deviation(i), unknowns.reach[i], own, from);
}

std::vector<DeviatingNumber> deviating_numbers(const ArmModel& model, const Unknowns& unknowns,
                                               const JackknifeEstimate& estimate) {
  ArmParameters<double> given = model.nominal;
  const std::vector<ParameterInfo> all = named_parameters(given);
  std::vector<DeviatingNumber> deviating;
  for (Eigen::Index i = unknowns.learnt; i < estimate.u.size(); ++i) {
    const Weight& weight = unknowns.weights[i];
    const double tolerances = estimate.u(i) / 2;  // the prior's deviation is half a tolerance
    if (std::abs(tolerances) < kDeviating || std::abs(estimate.u(i)) < kChance * estimate.deviation(i)) continue;
    const auto info = std::ranges::find(all, weight.key, &ParameterInfo::key);
    deviating.push_back({.name = info->name,
                         .unit = info->unit,
                         .nominal = weight.nominal,
                         .value = weight.value(estimate.u(i)),
                         .tolerances = tolerances});
  }
  return deviating;
}

struct Estimates {
  FilterTrace trace;
  BatchEstimate batch;
};

Estimates estimate(const ArmModel& model, const Unknowns& unknowns, const std::vector<Log>& logs,
                   const std::function<void(const std::string&, double)>& progress) {
  const auto tell = [&](const std::string& stage, double fraction) {
    if (progress) progress(stage, fraction);
  };
  Estimates e;
  e.trace = run_dual_filter(model, unknowns, logs, 1, [&](double fraction) { tell("dual filter", fraction); });
  e.batch = estimate_from_blocks(model, unknowns, logs, e.trace.last_u, [&](int pass, double fraction) {
    tell(fmt::format("estimate, pass {}", pass), fraction);
  });
  if (e.batch.disturbances == 1 || !e.trace.failure.empty()) return e;
  // What the filter makes of the log with the noise that the log asks for.
  FilterTrace again = run_dual_filter(model, unknowns, logs, e.batch.disturbances,
                                      [&](double fraction) { tell("dual filter, once more", fraction); });
  if (again.failure.empty()) e.trace = std::move(again);
  return e;
}

}  // namespace

Identification identify(const ArmModel& model, const std::vector<Log>& logs, const std::vector<std::string>& keys,
                        const std::function<void(const std::string&, double)>& progress) {
  check_logs(model, logs, keys);
  const Unknowns unknowns = list_unknowns(model, keys);
  Estimates found;
  try {
    found = estimate(model, unknowns, logs, progress);
  } catch (const std::runtime_error& e) {
    throw InputError(fmt::format("{}: cannot be followed by {}: {}", logs.front().source, model.source, e.what()));
  }

  Identification result;
  result.model = model;
  result.time = found.trace.time;
  result.blocks = found.batch.estimate.blocks;
  result.converged = found.batch.converged;
  result.innovation_size = found.batch.innovation_size;
  result.disturbances = found.batch.disturbances;
  result.filter_failure = found.trace.failure;
  for (const ParameterInfo& info : named_parameters(result.model.nominal)) {
    if (std::ranges::find(keys, info.key) == keys.end()) continue;
    const auto i = static_cast<Eigen::Index>(result.numbers.size());
    IdentifiedNumber& number = result.numbers.emplace_back();
    number.key = info.key, number.name = info.name, number.unit = info.unit;
    number.joint = info.joint, number.nominal = info.number.get();
    tell_number(unknowns, i, found.batch.estimate, found.trace, number);
    info.number.set(number.value);
  }
  for (PlacedEffect& e : result.model.effects) keep_within_bounds(e, result.model.nominal);
  result.deviating = deviating_numbers(model, unknowns, found.batch.estimate);
  return result;
}

}  // namespace halyard
