#include "estimators/identification/unknowns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "estimators/identification/identified_keys.h"
#include "model/drive_ratio.h"

namespace halyard {
namespace {

constexpr double kCouplingSpread = 0.3, kSpread = 0.5;          // relative, of what is asked for
constexpr double kZeroSpread = 0.05, kZeroSpreadLength = 0.01;  // rad | m at the joint
constexpr double kRoutingRadius = 0.01;  // m, of a pulley that a cable passes; scale of a coupling of 0

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

/// The joints of whose ratio one of the keys is a length.
std::vector<bool> with_asked_ratio(const ArmModel& model, const std::vector<std::string>& keys) {
  ArmParameters<double> arm = model.nominal;
  std::vector<bool> asked(model.n(), false);
  for (const ParameterInfo& info : named_parameters(arm))
    if (is_of_ratio(info) && std::ranges::find(keys, info.key) != keys.end()) asked[info.joint] = true;
  return asked;
}

/// Numbers that the model knows within a tolerance, but those that are asked for. The ratio of a drive is one number,
/// the capstan's radius, unless a length of it is asked for: no data tell two apart. A link is uncertain by its mass
/// alone: with more numbers the sigma points lie farther apart, and some arms among them cannot be integrated.
std::vector<Weight> other_numbers(const ArmModel& model, const std::vector<std::string>& keys) {
  ArmParameters<double> arm = model.nominal;
  const std::vector<bool> has_asked_ratio = with_asked_ratio(model, keys);
  std::vector<Weight> others;
  for (const ParameterInfo& info : named_parameters(arm)) {
    if (is_of_ratio(info) && has_asked_ratio[info.joint]) continue;
    if (info.tolerance == &Tolerances::com || info.tolerance == &Tolerances::inertia) continue;
    if (std::ranges::find(keys, info.key) != keys.end() || !is_in_equations(model, info)) continue;
    const double reach = reach_with_one_ratio(model, info);
    if (reach > 0) others.push_back({.key = info.key, .nominal = info.number.get(), .scale = reach / 2});
  }
  return others;
}

}  // namespace

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

Eigen::VectorXd Unknowns::bound() const {
  constexpr double kFurthest = 20, kLost = 0.75;  // prior deviations: ten tolerances; of the value
  Eigen::VectorXd all = Eigen::VectorXd::Constant(count(), std::numeric_limits<double>::infinity());
  for (Eigen::Index i = learnt; i < count(); ++i)
    all(i) = std::min(kFurthest, kLost * std::abs(weights[i].nominal) / weights[i].scale);
  return all;
}

bool has_unknown_zeros(const ArmModel& model) { return !unknown_zeros(model).empty(); }

}  // namespace halyard
