#include "estimators/identification/identify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "estimators/distributions.h"
#include "estimators/identification/block_jackknife.h"
#include "model/input_error.h"

namespace halyard {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kShortest = 3;  // s of a log
constexpr int kBlocks = 20;      // of a second or longer, where the logs are long enough
constexpr int kFewestBlocks = 6;
constexpr double kTraceRows = 1000;
constexpr int kPasses = 8;
constexpr double kConvergedStep = 0.2;                  // a step of fewer standard deviations is the last
constexpr double kExcited = 0.5;                        // of the prior's deviation: what was learnt is worth telling
constexpr double kCouplingSpread = 0.3, kSpread = 0.5;  // relative, of what is asked for
constexpr double kZeroSpread = 0.05, kZeroSpreadLength = 0.01;  // rad | m at the joint
constexpr double kRoutingRadius = 0.01;  // m, of a pulley that a cable passes; scale of a coupling of 0
constexpr double kChance = 3;            // standard deviations
constexpr double kDeviating = 2;         // tolerances: cables' damping in quiet logs comes out up to 1.6 too large
constexpr double kMatters = 0.1;         // of a tolerance: a drift by less is none

Weight weight_of(const ArmModel& model, const ParameterInfo& info) {
  const bool coupling = info.key.find(".coupling.") != info.key.npos;
  if (!coupling && info.least >= 0)
    return {.key = info.key, .nominal = info.number.get(), .scale = kSpread, .logarithmic = true};
  if (!coupling) return {.key = info.key, .nominal = info.number.get(), .scale = kSpread * std::abs(info.number.get())};
  const JointParameters<double>& j = model.nominal.joint[info.joint];
  const int inboard = std::stoi(info.key.substr(info.key.rfind("joint") + 5)) - 1;
  const double routing = model.nominal.joint[inboard].type == JointType::revolute ? kRoutingRadius : 1;
  const double size = info.number.get() != 0 ? std::abs(info.number.get()) : routing / std::abs(j.pulley_radius);
  return {.key = info.key, .nominal = info.number.get(), .scale = kCouplingSpread * size};
}

/// What the first second of a log tells of a zero hangs on the couplings.
std::vector<Weight> unknown_zeros(const ArmModel& model) {
  std::vector<Weight> zeros;
  for (int k = 0; k < model.n(); ++k) {
    const JointParameters<double>& j = model.nominal.joint[k];
    if (j.drive == Drive::none || (j.motor_zero_known && j.joint_zero_known)) continue;
    const double spread = j.type == JointType::revolute ? kZeroSpread : kZeroSpreadLength;
    zeros.push_back({.key = "joint" + std::to_string(k + 1) + ".motor.zero",
                     .nominal = j.motor_encoder_offset,
                     .scale = spread * std::abs(j.pulley_radius) / j.motor_travel()});
  }
  return zeros;
}

/// Numbers that the model knows within a tolerance, but those that are asked for. The ratio of a drive is one number,
/// the capstan's radius. A link is uncertain by its mass alone: with more numbers the sigma points lie farther apart,
/// and some arms among them cannot be integrated.
std::vector<Weight> other_numbers(const ArmModel& model, const std::vector<std::string>& keys) {
  ArmParameters<double> arm = model.nominal;
  std::vector<Weight> others;
  for (const ParameterInfo& info : named_parameters(arm)) {
    if (info.key.ends_with(".gear_ratio") || info.key.ends_with(".pulley_radius")) continue;
    if (info.tolerance == &Tolerances::com || info.tolerance == &Tolerances::inertia) continue;
    if (std::ranges::find(keys, info.key) != keys.end() || !is_in_equations(model, info)) continue;
    const double reach = model.reach(info);
    if (reach > 0) others.push_back({.key = info.key, .nominal = info.number.get(), .scale = reach / 2});
  }
  return others;
}

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
  if (logs.size() > 1 && !unknown_zeros(model).empty())
    throw InputError(
        fmt::format("{}: its encoders have a zero of their own in each log; give one log, or write their "
                    "offsets into the model",
                    model.source));
}

double duration_of(const std::vector<Log>& logs) {
  double whole = 0;
  for (const Log& log : logs) whole += log.duration();
  return whole;
}

/// Calls visit(step, time) for each sample of the logs; time goes on from log to log.
template <class Visit>
void run_filter(DualUkf& filter, const std::vector<Log>& logs, const std::function<void(double)>& progress,
                const Visit& visit) {
  double before = 0;
  const double whole = duration_of(logs);
  for (const Log& log : logs) {
    filter.start_record();
    const auto n = static_cast<Eigen::Index>(log.n_joints);
    const auto cell = [](const std::vector<double>& column, std::size_t i) {
      return column.empty() ? kNan : column[i];
    };
    EncoderSample sample;
    sample.motor_torque.resize(n), sample.motor_position.resize(n), sample.joint_position.resize(n);
    sample.joint_torque.resize(n);
    for (std::size_t i = 0; i < log.size(); ++i) {
      sample.time_s = log.time[i];
      for (Eigen::Index k = 0; k < n; ++k) {
        const auto j = static_cast<std::size_t>(k);
        sample.motor_torque(k) = cell(log.motor_torque[j], i);
        sample.motor_position(k) = cell(log.motor_position[j], i);
        sample.joint_position(k) = cell(log.joint_position[j], i);
        sample.joint_torque(k) = cell(log.joint_torque[j], i);
      }
      const double time = before + log.time[i] - log.time[0];
      visit(filter.update(sample), time);
      if (progress && i % 200 == 0) progress(time / whole);
    }
    before += log.duration();
  }
}

std::vector<BlockSums> sum_blocks(const ArmModel& model, const std::vector<Weight>& weights, const Eigen::VectorXd& u,
                                  const std::vector<Log>& logs, const std::function<void(double)>& progress) {
  const double whole = duration_of(logs);
  const int count = std::clamp(static_cast<int>(whole), kFewestBlocks, kBlocks);
  const auto p = u.size();
  std::vector<BlockSums> blocks(count, {Eigen::MatrixXd::Zero(p, p), Eigen::VectorXd::Zero(p)});
  DualUkf filter(model, weights, {.learn = false});
  filter.set_weights(u, Eigen::MatrixXd::Identity(p, p));
  run_filter(filter, logs, progress, [&](const DualStep& step, double time) {
    if (step.nu.size() == 0) return;
    BlockSums& block = blocks[std::min(static_cast<int>(time / whole * count), count - 1)];
    const auto S = step.S_root.triangularView<Eigen::Lower>();
    const Eigen::MatrixXd white = S.solve(step.Y);
    block.A.selfadjointView<Eigen::Lower>().rankUpdate(white.transpose());
    block.g += white.transpose() * S.solve(step.nu);
  });
  for (BlockSums& b : blocks) b.A = b.A.selfadjointView<Eigen::Lower>();
  return blocks;
}

/// How far a number that is known within a tolerance may be pulled, in prior deviations: at least a quarter of it is
/// left, since a cable that pushes is no cable, and beyond ten tolerances it stands for something else that the model
/// lacks.
double bound_of(const Weight& other) { return std::min(20.0, 0.75 * std::abs(other.nominal) / other.scale); }

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

/// What is estimated, in this order: the numbers asked for; zeros of encoders, if unknown; the model's other numbers.
/// The dual filter learns the first two kinds.
struct Unknowns {
  std::vector<Weight> weights;
  std::vector<double> reach;  ///< tolerances of those asked for, in their units
  Eigen::Index asked = 0, learnt = 0;

  std::vector<Weight> learnt_weights() const { return {weights.begin(), weights.begin() + learnt}; }
};

Unknowns list_unknowns(const ArmModel& model, const std::vector<std::string>& keys) {
  ArmParameters<double> arm = model.nominal;
  Unknowns all;
  for (const ParameterInfo& info : named_parameters(arm)) {
    if (std::ranges::find(keys, info.key) == keys.end()) continue;
    all.weights.push_back(weight_of(model, info));
    all.reach.push_back(model.reach(info));
  }
  all.asked = static_cast<Eigen::Index>(all.weights.size());
  for (Weight& zero : unknown_zeros(model)) all.weights.push_back(std::move(zero));
  all.learnt = static_cast<Eigen::Index>(all.weights.size());
  for (Weight& other : other_numbers(model, keys)) all.weights.push_back(std::move(other));
  return all;
}

/// What the dual filter believed over the logs, and at their end.
struct FilterTrace {
  std::vector<double> time;
  std::vector<Eigen::VectorXd> u, deviation;
  Eigen::VectorXd last_u, last_deviation;
};

FilterTrace run_dual_filter(const ArmModel& model, const Unknowns& unknowns, const std::vector<Log>& logs,
                            const std::function<void(double)>& progress) {
  FilterTrace trace;
  DualUkf filter(model, unknowns.learnt_weights());
  const double row_span = duration_of(logs) / kTraceRows;
  double next = 0;
  run_filter(filter, logs, progress, [&](const DualStep&, double time) {
    if (time < next) return;
    next += row_span;
    trace.time.push_back(time);
    trace.u.push_back(filter.w());
    trace.deviation.emplace_back(filter.S_w().rowwise().norm());
  });
  trace.last_u = filter.w();
  trace.last_deviation = filter.S_w().rowwise().norm();
  return trace;
}

/// Where Gauss and Newton's steps end, and whether the numbers asked for have converged there.
struct Refined {
  JackknifeEstimate estimate;
  bool converged = false;
};

/// progress(pass, fraction), passes from 1.
Refined refine(const ArmModel& model, const Unknowns& unknowns, const std::vector<Log>& logs,
               const Eigen::VectorXd& learnt_u, const std::function<void(int, double)>& progress) {
  Refined r;
  const auto p = static_cast<Eigen::Index>(unknowns.weights.size());
  r.estimate.u = Eigen::VectorXd::Zero(p);
  r.estimate.u.head(unknowns.learnt) = learnt_u;
  Eigen::VectorXd bound = Eigen::VectorXd::Constant(p, std::numeric_limits<double>::infinity());
  for (Eigen::Index i = unknowns.learnt; i < p; ++i) bound(i) = bound_of(unknowns.weights[i]);
  for (int pass = 1; pass <= kPasses && !r.converged; ++pass) {
    const Eigen::VectorXd before = r.estimate.u;
    const auto tell = [&](double fraction) { progress(pass, fraction); };
    r.estimate = jackknife_least_squares(sum_blocks(model, unknowns.weights, before, logs, tell), before, bound);
    const Eigen::ArrayXd step = (r.estimate.u - before).head(unknowns.asked).array().abs();
    r.converged = (step <= kConvergedStep * r.estimate.deviation.head(unknowns.asked).array()).all();
  }
  return r;
}

/// The i-th of the numbers asked for, but for what named_parameters() says of it.
void tell_number(const Unknowns& unknowns, Eigen::Index i, const JackknifeEstimate& estimate, const FilterTrace& trace,
                 IdentifiedNumber& number) {
  const Weight& weight = unknowns.weights[i];
  const double u = estimate.u(i), reach = t_quantile(estimate.blocks - 1, 0.025) * estimate.deviation(i);
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

}  // namespace

Identification identify(const ArmModel& model, const std::vector<Log>& logs, const std::vector<std::string>& keys,
                        const std::function<void(const std::string&, double)>& progress) {
  check_logs(model, logs, keys);
  const auto tell = [&](const std::string& stage, double fraction) {
    if (progress) progress(stage, fraction);
  };
  const Unknowns unknowns = list_unknowns(model, keys);
  const FilterTrace trace =
      run_dual_filter(model, unknowns, logs, [&](double fraction) { tell("dual filter", fraction); });
  const Refined refined = refine(model, unknowns, logs, trace.last_u, [&](int pass, double fraction) {
    tell(fmt::format("estimate, pass {}", pass), fraction);
  });

  Identification result;
  result.model = model;
  result.time = trace.time;
  result.blocks = refined.estimate.blocks;
  result.converged = refined.converged;
  for (const ParameterInfo& info : named_parameters(result.model.nominal)) {
    if (std::ranges::find(keys, info.key) == keys.end()) continue;
    const auto i = static_cast<Eigen::Index>(result.numbers.size());
    IdentifiedNumber& number = result.numbers.emplace_back();
    number.key = info.key, number.name = info.name, number.unit = info.unit;
    number.joint = info.joint, number.nominal = info.number.get();
    tell_number(unknowns, i, refined.estimate, trace, number);
    info.number.set(number.value);
  }
  for (PlacedEffect& e : result.model.effects) keep_within_bounds(e, result.model.nominal);
  result.deviating = deviating_numbers(model, unknowns, refined.estimate);
  return result;
}

}  // namespace halyard
