#include "diagnosis/log_check/log_under_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "diagnosis/log_check/robust.h"
#include "diagnosis/record/sampled_column.h"
#include "model/statistics/quantile.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kMostPoints = 4000;  ///< of a grid: 130 Hz over 30 s, enough for the motion of an arm
constexpr double kHole = 0.1;         ///< s; a longer hole in a column is not bridged

/// A column at the instants; NaN in holes. Empty if the log lacks it.
std::vector<double> at_instants(const Log& log, const std::vector<double>& column, const std::vector<double>& time) {
  const SampledColumn sampled(log.time, column);
  if (!sampled.is_there()) return {};
  const double bridged = std::max(kHole, 1.5 * sampled.interval());
  std::vector<double> values;
  for (const double t : time) values.push_back(sampled.hole_at(t) <= bridged ? sampled.at(t) : kNone);
  return values;
}

constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

SampledMotion sampled_motion(const Log& log, const ArmModel& model) {
  SampledMotion m;
  const int n = log.n_joints;
  m.step = std::max(SampledColumn(log.time, log.time).interval(), log.duration() / kMostPoints);
  for (double t = log.time.front(); t <= log.time.back(); t += m.step) m.time.push_back(t);
  Signals motor(n);
  for (int k = 0; k < n; ++k) {
    if (model.nominal.joint[k].drive != Drive::none) motor[k] = at_instants(log, log.motor_position[k], m.time);
    m.joint.push_back(at_instants(log, log.joint_position[k], m.time));
  }
  m.expected.resize(n), m.own.resize(n);
  for (int k = 0; k < n; ++k)
    if (!motor[k].empty()) m.expected[k].resize(m.time.size()), m.own[k].resize(m.time.size());
  const UnstretchedJoints unstretched(model.nominal);
  Eigen::VectorXd q_m = Eigen::VectorXd::Zero(n), undriven = model.home(), q;
  for (std::size_t i = 0; i < m.time.size(); ++i) {
    for (int k = 0; k < n; ++k) {
      const JointParameters<double>& j = model.nominal.joint[k];
      if (!motor[k].empty()) q_m(k) = motor[k][i] - j.motor_encoder_offset;
      else if (!m.joint[k].empty()) undriven(k) = m.joint[k][i] - j.joint_encoder_offset;
    }
    unstretched.solve(q_m, undriven, q);
    for (int k = 0; k < n; ++k) {
      const JointParameters<double>& j = model.nominal.joint[k];
      if (motor[k].empty()) continue;
      m.expected[k][i] = q(k) + j.joint_encoder_offset;
      m.own[k][i] = j.motor_travel() / j.pulley_radius * q_m(k);
    }
  }
  return m;
}

double LogUnderCheck::joint_per_motor(int k) const {
  const JointParameters<double>& j = model.nominal.joint[k];
  return j.motor_travel() / j.pulley_radius;
}

bool LogUnderCheck::has_gross() const {
  return std::ranges::any_of(findings, [](const LogFinding& f) { return f.severity == LogFinding::Severity::gross; });
}

bool LogUnderCheck::has_finding(const std::string& column) const {
  return std::ranges::count(findings, column, &LogFinding::column) > 0;
}

double LogUnderCheck::beyond_range(int k, const std::vector<double>& position, bool zero_known) const {
  if (!(range(k) > 0)) return 0;
  // Motors and joints overshoot their range a little.
  double beyond = std::max(0.0, spread(position) / range(k) - 1.2);
  if (zero_known) {
    const double level = median(position);
    beyond += std::max({0.0, model.joints[k].lower - level, level - model.joints[k].upper}) / range(k);
  }
  return beyond;
}

std::string LogUnderCheck::position(int k, double value) const {
  if (model.nominal.joint[k].type == JointType::prismatic) return fmt::format("{:.4g} m", value);
  return fmt::format("{:.4g} rad ({:.4g} deg)", value, value / kDegree);
}

std::string LogUnderCheck::range_in_words(int k) const {
  const double lower = model.joints[k].lower, upper = model.joints[k].upper;
  if (model.nominal.joint[k].type == JointType::prismatic) return fmt::format("{:.4g} to {:.4g} m", lower, upper);
  return fmt::format("{:.4g} to {:.4g} rad ({:.4g} to {:.4g} deg)", lower, upper, lower / kDegree, upper / kDegree);
}

ColumnSource LogUnderCheck::source_of(const std::string& column) const {
  const auto found = sources_.find(column);
  return found == sources_.end() ? ColumnSource{column} : found->second;
}

std::string LogUnderCheck::option(const std::string& column, const ColumnSource& source) const {
  std::string text = fmt::format("--column {}={}", column, source.column);
  const double size = std::abs(source.scale);
  std::vector<UnitGuess> units = {{"ms", 1e-3, ""}, {"us", 1e-6, ""}};
  if (column.find("torque") != column.npos) units = {{"mN.m", 1e-3, ""}};
  if (column.find("position") != column.npos) {
    units = position_units(false, 0);
    const std::vector<UnitGuess> lengths = position_units(true, 0);
    units.insert(units.end(), lengths.begin(), lengths.end());
  }
  const auto unit = std::ranges::find_if(
      units, [&](const UnitGuess& u) { return !u.name.empty() && std::abs(size / u.factor - 1) < 1e-6; });
  if (unit != units.end()) text += ",unit=" + unit->name;
  else if (std::abs(size - 1) > 1e-9) text += fmt::format(",scale={:.6g}", size);
  if (source.scale < 0) text += ",sign=-1";
  if (source.offset != 0) text += fmt::format(",offset={:.{}g}", source.offset, source.wrap > 0 ? 12 : 6);
  if (source.wrap > 0) text += fmt::format(",wrap={:.12g}", source.wrap);
  return text;
}

ColumnSource LogUnderCheck::corrected(const std::string& column, const Correction& c) const {
  ColumnSource source = source_of(column);
  source.scale *= c.factor * c.unit_factor;
  source.offset = c.factor * source.offset + c.offset;
  return source;
}

std::string LogUnderCheck::option(const std::string& column, const Correction& c) const {
  return option(column, corrected(column, c));
}

std::string LogUnderCheck::wrap_option(const std::string& column, double period) const {
  ColumnSource source = source_of(column);
  source.wrap = period / std::abs(source.scale);
  return option(column, source);
}

double LogUnderCheck::wrap_of(const std::string& column) const {
  const ColumnSource source = source_of(column);
  return source.wrap * std::abs(source.scale);
}

std::vector<ColumnSource> LogUnderCheck::exchanged(const ColumnCircle& circle) const {
  std::vector<ColumnSource> sources;
  for (std::size_t i = 0; i < circle.size(); ++i) {
    const ColumnSource from = source_of(circle[(i + 1) % circle.size()].name());
    ColumnSource to = source_of(circle[i].name());
    to.column = from.column, to.wrap = from.wrap;
    sources.push_back(to);
  }
  return sources;
}

std::string LogUnderCheck::exchange_options(const ColumnCircle& circle) const {
  const std::vector<ColumnSource> sources = exchanged(circle);
  std::string options;
  for (std::size_t i = 0; i < circle.size(); ++i) options += (i > 0 ? " " : "") + option(circle[i].name(), sources[i]);
  return options;
}

void LogUnderCheck::correct(Signals Log::*signal, int k, const Correction& c) {
  const std::string column = column_name(signal, k);
  const double of_map = source_of(column).offset;
  for (double& x : (log.*signal)[k]) x = c.factor * (c.unit_factor * (x - of_map) + of_map) + c.offset;
  sources_[column] = corrected(column, c);
}

void LogUnderCheck::exchange(const ColumnCircle& circle) {
  const std::vector<ColumnSource> sources = exchanged(circle);
  std::vector<std::vector<double>> values;
  for (std::size_t i = 0; i < circle.size(); ++i) {
    const ColumnPlace& behind = circle[(i + 1) % circle.size()];
    const ColumnSource from = source_of(behind.name());
    values.push_back((log.*behind.signal)[behind.k]);
    for (double& x : values.back()) x = (x - from.offset) / from.scale * sources[i].scale + sources[i].offset;
  }
  for (std::size_t i = 0; i < circle.size(); ++i) {
    (log.*circle[i].signal)[circle[i].k] = std::move(values[i]);
    sources_[circle[i].name()] = sources[i];
  }
}

std::string column_name(Signals Log::*signal, int k) {
  const char* name = signal == &Log::motor_torque     ? "motor_torque"
                     : signal == &Log::motor_position ? "motor_position"
                     : signal == &Log::joint_position ? "joint_position"
                                                      : "joint_torque";
  return fmt::format("{}_{}", name, k + 1);
}

std::vector<UnitGuess> position_units(bool prismatic, double resolution) {
  std::vector<UnitGuess> units;
  if (prismatic) units = {{"mm", 1e-3, "millimetres"}, {"um", 1e-6, "micrometres"}, {"", 1e-2, "centimetres"}};
  else units = {{"deg", kDegree, "degrees"}, {"turn", 2 * std::numbers::pi, "turns"}, {"", 1e-3, "milliradians"}};
  if (resolution > 0) units.push_back({"", resolution, "counts of its encoder"});
  return units;
}

}  // namespace halyard
