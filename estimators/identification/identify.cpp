#include "estimators/identification/identify.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "model/input_error.h"

namespace halyard {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kShortest = 3;  // s of a log
constexpr int kBlocks = 20;      // of a second or longer, where the logs are long enough
constexpr int kFewestBlocks = 6;
constexpr double kTraceRows = 1000;
constexpr int kPasses = 8;
constexpr double kStands = 0.2;                         // a step of fewer standard deviations is the last
constexpr double kExcited = 0.5;                        // of the prior's deviation: what was learnt is worth telling
constexpr double kCouplingSpread = 0.3, kSpread = 0.5;  // relative, of what is asked for
constexpr double kZeroSpread = 0.05, kZeroSpreadLength = 0.01;  // rad | m at the joint
constexpr double kRoutingRadius = 0.01;  // m, of a pulley that a cable passes; scale of a coupling of 0
constexpr double kChance = 3;            // standard deviations
constexpr double kStrained = 2;          // tolerances: cables' damping in quiet logs comes out up to 1.6 too large
constexpr double kMatters = 0.1;         // of a tolerance: a drift by less is none

struct Kind {
  const char* word;
  std::vector<const char*> parts;
};
const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {{"coupling", {".coupling."}},
                                        {"stiffness", {".cable.stiffness"}},
                                        {"damping", {".cable.damping"}},
                                        {"tension", {".cable.tension"}},
                                        {"motor_friction", {".motor.coulomb", ".motor.viscous"}},
                                        {"joint_friction", {".friction.coulomb", ".friction.viscous"}}};
  return all;
}

bool is_of(const Kind& kind, const std::string& key) {
  return std::ranges::any_of(kind.parts, [&](const char* part) { return key.find(part) != key.npos; });
}

/// Eq. 6 takes no tension.
bool is_in_equations(const ArmModel& model, const ParameterInfo& info) {
  return !info.key.ends_with(".cable.tension") || model.nominal.joint[info.joint].law != CableLaw::paper;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

[[noreturn]] void fail_kind(const ArmModel& model, const Kind& kind) {
  const std::string word = kind.word;
  const std::string place = fmt::format("parameter {}: {} ", in_quotes(word), model.source);
  if (word == "coupling" && model.n() == 1)
    throw InputError(place + "has one joint, and a joint is coupled with inboard ones; ask for another number");
  if (word == "tension")
    throw InputError(place + "has no cable law that takes tension; write law=\"exponential\" in its <cable>");
  throw InputError(place +
                   "has no such number, or only numbers of 0; ask for others, or name a coupling of 0 by its "
                   "key, such as joint2.coupling.joint1");
}

Weight weight_of(const ArmModel& model, const ParameterInfo& info) {
  const bool coupling = info.key.find(".coupling.") != info.key.npos;
  if (!coupling) return {info.key, *info.value, kSpread, true};
  const JointParameters<double>& j = model.nominal.joint[info.joint];
  const int inboard = std::stoi(info.key.substr(info.key.rfind("joint") + 5)) - 1;
  const double routing = model.nominal.joint[inboard].type == JointType::revolute ? kRoutingRadius : 1;
  const double size = *info.value != 0 ? std::abs(*info.value) : routing / std::abs(j.pulley_radius);
  return {info.key, *info.value, kCouplingSpread * size, false};
}

/// What the first second of a log tells of a zero hangs on the couplings.
std::vector<Weight> unknown_zeros(const ArmModel& model) {
  std::vector<Weight> zeros;
  for (int k = 0; k < model.n(); ++k) {
    const JointParameters<double>& j = model.nominal.joint[k];
    if (j.drive == Drive::none || (j.motor_zero_known && j.joint_zero_known)) continue;
    const double spread = j.type == JointType::revolute ? kZeroSpread : kZeroSpreadLength;
    zeros.push_back({"joint" + std::to_string(k + 1) + ".motor.zero", j.motor_encoder_offset,
                     spread * std::abs(j.pulley_radius) / j.motor_travel(), false});
  }
  return zeros;
}

/// All numbers that the model knows within a tolerance, but those that are asked for. The ratio of a drive is one
/// number, the capstan's radius.
std::vector<Weight> other_numbers(const ArmModel& model, const std::vector<std::string>& keys) {
  ArmParameters<double> arm = model.nominal;
  std::vector<Weight> others;
  for (const ParameterInfo& info : named_parameters(arm)) {
    if (info.key.ends_with(".gear_ratio") || info.key.ends_with(".pulley_radius")) continue;
    if (std::ranges::find(keys, info.key) != keys.end() || !is_in_equations(model, info)) continue;
    const double reach = model.tolerance(info) * std::abs(*info.value);
    if (reach > 0) others.push_back({info.key, *info.value, reach / 2, false});
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
          fmt::format("{}: lasts {:.3g} s; an identification takes {:g} s at least, and more is better: "
                      "give a longer log",
                      log.source, log.duration(), kShortest));
  if (logs.size() > 1 && !unknown_zeros(model).empty())
    throw InputError(
        fmt::format("{}: its encoders have a zero of their own in each log; give one log, or write their "
                    "offsets into the model",
                    model.source));
}

/// Calls visit(step, time) for each sample of the logs; time goes on from log to log.
template <class Visit>
void run_filter(DualUkf& filter, const std::vector<Log>& logs, const std::function<void(double)>& progress,
                const Visit& visit) {
  double before = 0, whole = 0;
  for (const Log& log : logs) whole += log.duration();
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

/// Least squares of one block of the logs.
struct Block {
  Eigen::MatrixXd A;
  Eigen::VectorXd g;
};

std::vector<Block> sum_blocks(const ArmModel& model, const std::vector<Weight>& weights, const Eigen::VectorXd& u,
                              const std::vector<Log>& logs, const std::function<void(double)>& progress) {
  double whole = 0;
  for (const Log& log : logs) whole += log.duration();
  const int count = std::clamp(static_cast<int>(whole), kFewestBlocks, kBlocks);
  const auto p = u.size();
  std::vector<Block> blocks(count, {Eigen::MatrixXd::Zero(p, p), Eigen::VectorXd::Zero(p)});
  DualUkf filter(model, weights, {.learn = false});
  filter.set_weights(u, Eigen::MatrixXd::Identity(p, p));
  run_filter(filter, logs, progress, [&](const DualStep& step, double time) {
    if (step.nu.size() == 0) return;
    Block& block = blocks[std::min(static_cast<int>(time / whole * count), count - 1)];
    const auto S = step.S_root.triangularView<Eigen::Lower>();
    const Eigen::MatrixXd white = S.solve(step.Y);
    block.A.selfadjointView<Eigen::Lower>().rankUpdate(white.transpose());
    block.g += white.transpose() * S.solve(step.nu);
  });
  for (Block& b : blocks) b.A = b.A.selfadjointView<Eigen::Lower>();
  return blocks;
}

struct LeastSquares {
  Eigen::VectorXd u;
  Eigen::VectorXd deviation;  // of u
  int blocks = 0;
};

/// How far a number that is known within a tolerance may be pulled, in prior deviations: at least a quarter of it is
/// left, since a cable that pushes is no cable, and beyond ten tolerances it stands for something else that the model
/// lacks.
double bound_of(const Weight& other) { return std::min(20.0, 0.75 * std::abs(other.nominal) / other.scale); }

/// The step from `u` and the jackknife around its end; |u + step| <= bound.
LeastSquares solve(const std::vector<Block>& blocks, const Eigen::VectorXd& u, const Eigen::VectorXd& bound) {
  const auto p = u.size();
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(p, p);
  Eigen::VectorXd g = -u;
  for (const Block& b : blocks) A += b.A, g += b.g;

  // One number after the other is held at its bound, the one that is furthest beyond first.
  Eigen::VectorXd step = Eigen::VectorXd::Zero(p);
  std::vector<int> free(static_cast<std::size_t>(p));
  std::iota(free.begin(), free.end(), 0);
  for (;;) {
    const Eigen::VectorXd rest = g - A * step;
    step(free) += A(free, free).ldlt().solve(rest(free));
    const auto furthest = std::ranges::max_element(free, {}, [&](int i) { return std::abs((u + step)(i)) / bound(i); });
    if (std::abs((u + step)(*furthest)) <= bound(*furthest)) break;
    step(*furthest) = std::copysign(bound(*furthest), (u + step)(*furthest)) - u(*furthest);
    free.erase(furthest);
  }

  const double count = static_cast<double>(blocks.size());
  const Eigen::MatrixXd A_free = A(free, free);
  Eigen::VectorXd held = step;
  held(free).setZero();
  Eigen::MatrixXd without(A_free.rows(), static_cast<Eigen::Index>(blocks.size()));
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Eigen::VectorXd rest = (g - blocks[b].g) - (A - blocks[b].A) * held;
    without.col(static_cast<Eigen::Index>(b)) = (A_free - blocks[b].A(free, free)).ldlt().solve(rest(free));
  }
  const Eigen::VectorXd mean = without.rowwise().mean();
  const Eigen::MatrixXd inverse = A_free.ldlt().solve(Eigen::MatrixXd::Identity(A_free.rows(), A_free.rows()));
  const Eigen::VectorXd jackknife =
      (count - 1) / count * (without.colwise() - mean).rowwise().squaredNorm() + inverse.rowwise().squaredNorm();
  LeastSquares e;
  e.u = u + step;
  e.deviation.setZero(p);
  e.deviation(free) = jackknife.cwiseMax(inverse.diagonal()).cwiseSqrt();
  e.blocks = static_cast<int>(blocks.size());
  return e;
}

/// The first row of the trace's last third.
std::size_t last_third(const std::vector<double>& time) {
  return static_cast<std::size_t>(std::ranges::lower_bound(time, 2.0 / 3 * time.back()) - time.begin());
}

/// deviation: of the estimate, in prior deviations; own: the filter's own at the last third's start, in SI.
Convergence convergence_of(const IdentifiedNumber& number, double deviation, double tolerance, double own,
                           std::size_t from) {
  if (deviation > kExcited) return Convergence::not_excited;
  const double moved = std::abs(number.trace.back() - number.trace[from]);
  const bool matters = moved > kMatters * tolerance * std::abs(number.nominal);
  return matters && moved > kChance * own ? Convergence::drifting : Convergence::converged;
}

}  // namespace

std::vector<std::string> identified_keys(const ArmModel& model, const std::string& text) {
  ArmParameters<double> arm = model.nominal;
  const std::vector<ParameterInfo> all = named_parameters(arm);
  std::vector<bool> chosen(all.size(), false);
  for (const std::string& word : split(text)) {
    const auto kind = std::ranges::find_if(kinds(), [&](const Kind& k) { return word == k.word; });
    bool any = false;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool named = kind != kinds().end() ? is_of(*kind, all[i].key) && *all[i].value != 0 : all[i].key == word;
      if (!named || (kind != kinds().end() && !is_in_equations(model, all[i]))) continue;
      any = chosen[i] = true;
      if (!is_in_equations(model, all[i])) fail_kind(model, kinds()[3]);
      if (*all[i].value == 0 && word.find(".coupling.") == word.npos)
        throw InputError(
            fmt::format("parameter {}: is 0 in {}, which gives no scale to look for it; write a guess into "
                        "the model",
                        in_quotes(word), model.source));
    }
    if (any) continue;
    if (kind != kinds().end()) fail_kind(model, *kind);
    std::string words, keys;
    for (const Kind& k : kinds()) words += (words.empty() ? "" : ", ") + std::string(k.word);
    for (const ParameterInfo& info : all) keys += (keys.empty() ? "" : ", ") + info.key;
    throw InputError(
        fmt::format("parameter {}: {} has none of that name; expected some of {}, or of the keys {}, with "
                    "commas between",
                    in_quotes(word), model.source, words, keys));
  }
  std::vector<std::string> keys;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (chosen[i]) keys.push_back(all[i].key);
  return keys;
}

Identification identify(const ArmModel& model, const std::vector<Log>& logs, const std::vector<std::string>& keys,
                        const std::function<void(const std::string&, double)>& progress) {
  check_logs(model, logs, keys);
  Identification result;
  result.model = model;
  std::vector<Weight> weights;
  std::vector<double> tolerance;
  for (const ParameterInfo& info : named_parameters(result.model.nominal)) {
    if (std::ranges::find(keys, info.key) == keys.end()) continue;
    weights.push_back(weight_of(model, info));
    tolerance.push_back(model.tolerance(info));
    IdentifiedNumber& number = result.numbers.emplace_back();
    number.key = info.key, number.name = info.name, number.unit = info.unit;
    number.joint = info.joint, number.nominal = *info.value;
  }
  const auto asked = static_cast<Eigen::Index>(weights.size());
  for (Weight& zero : unknown_zeros(model)) weights.push_back(std::move(zero));
  const auto learnt = static_cast<Eigen::Index>(weights.size());

  // The dual filter, from the model's numbers on.
  double whole = 0;
  for (const Log& log : logs) whole += log.duration();
  DualUkf filter(model, weights);
  const auto stage = [&](const std::string& text) -> std::function<void(double)> {
    if (!progress) return {};
    return [&progress, text](double fraction) { progress(text, fraction); };
  };
  double next = 0;
  std::vector<Eigen::VectorXd> trace_u, trace_deviation;  // the filter's own
  run_filter(filter, logs, stage("dual filter"), [&](const DualStep&, double time) {
    if (time < next) return;
    next += whole / kTraceRows;
    result.time.push_back(time);
    trace_u.push_back(filter.w());
    trace_deviation.emplace_back(filter.S_w().rowwise().norm());
  });
  const Eigen::VectorXd deviation = filter.S_w().rowwise().norm();

  // The estimate around its end, the other numbers along.
  for (Weight& other : other_numbers(model, keys)) weights.push_back(std::move(other));
  LeastSquares estimate;
  estimate.u = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(weights.size()));
  Eigen::VectorXd bound = Eigen::VectorXd::Constant(estimate.u.size(), std::numeric_limits<double>::infinity());
  for (Eigen::Index i = learnt; i < bound.size(); ++i) bound(i) = bound_of(weights[i]);
  estimate.u.head(learnt) = filter.w();
  for (int pass = 0; pass < kPasses; ++pass) {
    const Eigen::VectorXd before = estimate.u;
    estimate = solve(sum_blocks(model, weights, before, logs, stage(fmt::format("estimate, pass {}", pass + 1))),
                     before, bound);
    const Eigen::ArrayXd step = (estimate.u - before).head(asked).array().abs();
    result.stands = (step <= kStands * estimate.deviation.head(asked).array()).all();
    if (result.stands) break;
  }

  result.blocks = estimate.blocks;
  const double t = boost::math::quantile(boost::math::students_t(estimate.blocks - 1), 0.975);
  for (Eigen::Index i = 0; i < asked; ++i) {
    IdentifiedNumber& number = result.numbers[i];
    const double u = estimate.u(i), reach = t * estimate.deviation(i);
    number.value = weights[i].value(u);
    number.lower = weights[i].value(u - reach);
    number.upper = weights[i].value(u + reach);
    *find_number(result.model.nominal, number.key) = number.value;
    const double widened = estimate.deviation(i) / deviation(i);
    for (std::size_t r = 0; r < trace_u.size(); ++r) {
      number.trace.push_back(weights[i].value(trace_u[r](i)));
      // What was known before is as wide as it is: only what was learnt is widened.
      const double own = std::min(1.0, trace_deviation[r](i));
      number.trace_std.push_back(std::abs(weights[i].slope(trace_u[r](i))) * own *
                                 (own * own + (1 - own * own) * widened));
    }
    const std::size_t from = last_third(result.time);
    const double own = std::abs(weights[i].slope(trace_u[from](i))) * trace_deviation[from](i);
    number.convergence = convergence_of(number, estimate.deviation(i), tolerance[i], own, from);
  }
  ArmParameters<double> given = model.nominal;
  const std::vector<ParameterInfo> all = named_parameters(given);
  for (Eigen::Index i = learnt; i < estimate.u.size(); ++i) {
    const double tolerances = estimate.u(i) / 2;  // the prior's deviation is half a tolerance
    if (std::abs(tolerances) < kStrained || std::abs(estimate.u(i)) < kChance * estimate.deviation(i)) continue;
    const auto info = std::ranges::find(all, weights[i].key, &ParameterInfo::key);
    result.strained.push_back(
        {info->name, info->unit, weights[i].nominal, weights[i].value(estimate.u(i)), tolerances});
  }
  return result;
}

}  // namespace halyard
