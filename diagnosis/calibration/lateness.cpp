#include "diagnosis/calibration/lateness.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "diagnosis/fit/fit.h"
#include "diagnosis/search_space.h"
#include "model/statistics/quantile.h"

namespace halyard {
namespace {

constexpr double kBlock = 1;  ///< s
constexpr std::size_t kFewestBlocks = 5;
constexpr double kAgree = 3;          ///< standard deviations
constexpr double kModelError = 2e-3;  ///< s; friction and stretch that are off by their tolerance look so late
constexpr double kExplains = 0.5;     ///< of the squares that offset and slope leave
constexpr double kLeastTold = 2e-4;   ///< s; stretch under the largest rates that a log contains looks so late
constexpr int kPasses = 3;
constexpr double kSettled = 1e-4;  ///< s

/// Sums of the normal equations of e = a + s p - d p'.
struct Normal {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double square = 0;

  void add(double e, double p, double p_dot) {
    const Eigen::Vector3d x(1, p, -p_dot);
    A += x * x.transpose();
    b += x * e;
    square += e * e;
  }
  Normal without(const Normal& block) const { return {A - block.A, b - block.b, square - block.square}; }
  Eigen::VectorXd solution(Eigen::Index unknowns = 3) const {
    return Eigen::MatrixXd(A.topLeftCorner(unknowns, unknowns)).ldlt().solve(Eigen::VectorXd(b.head(unknowns)));
  }
  double left() const { return square - b.dot(solution()); }
  /// What is left if d is 0.
  double left_without_delay() const { return square - b.head<2>().dot(solution(2)); }
};

struct JointLateness {
  int joint = 0;
  double delay = 0, variance = 0;
  double explains = 0;  ///< share of the squares that offset and slope leave
};

/// Of joint k; nothing if too little is known.
std::optional<JointLateness> joint_lateness(const std::vector<Record>& records,
                                            const std::vector<FullPrediction>& predictions, int k) {
  Normal all;
  std::map<std::pair<std::size_t, int>, Normal> blocks;
  for (std::size_t r = 0; r < records.size(); ++r) {
    const Record& record = records[r];
    if (!record.has_joint(k)) continue;
    const std::vector<double>& p = predictions[r].joint_reading[k];
    for (std::size_t i = 1; i + 1 < record.size; ++i) {
      if (!(record.joint_valid[k][i] > 0) || !(record.joint_measured[k][i] > 0)) continue;
      const double e = record.joint_raw[k][i] - p[i], rate = (p[i + 1] - p[i - 1]) / (2 * record.dt);
      if (!std::isfinite(e) || !std::isfinite(rate)) continue;
      all.add(e, p[i], rate);
      blocks[{r, static_cast<int>(std::floor(record.time(i) / kBlock))}].add(e, p[i], rate);
    }
  }
  if (blocks.size() < kFewestBlocks || !(all.left_without_delay() > 0)) return std::nullopt;
  JointLateness j{.joint = k};
  j.delay = all.solution()(2);
  const double n = static_cast<double>(blocks.size());
  double mean = 0, square = 0;
  for (const auto& [at, block] : blocks) {
    const double d = all.without(block).solution()(2);
    mean += d / n, square += d * d / n;
  }
  j.variance = std::max(0.0, (n - 1) * (square - mean * mean));
  j.explains = 1 - all.left() / all.left_without_delay();
  return j;
}

double weighted_mean(const std::vector<JointLateness>& joints, double error) {
  double sum = 0, weight = 0;
  for (const JointLateness& j : joints) {
    const double w = 1 / (j.variance + error * error);
    sum += w * j.delay, weight += w;
  }
  return weight > 0 ? sum / weight : 0;
}

/// The joints that agree on a lateness, if they are the majority. An effect at one joint disturbs that joint's.
std::vector<JointLateness> agreeing(std::vector<JointLateness> joints) {
  if (joints.empty()) return {};
  std::vector<double> delays;
  for (const JointLateness& j : joints) delays.push_back(j.delay);
  const double late = median(delays);
  const std::size_t all = joints.size();
  std::erase_if(joints, [&](const JointLateness& j) {
    return std::abs(j.delay - late) > kAgree * std::sqrt(j.variance) + kModelError;
  });
  return 2 * joints.size() > all ? joints : std::vector<JointLateness>{};
}

std::vector<Record> records_of(const Log& log, const ArmModel& model, double late) {
  RecordOptions options;
  options.slow_sensors_late_s = late;
  return make_records(log, model, options);
}

/// By the regression, without the model's tolerances.
std::vector<JointLateness> regressed(const Log& log, const ArmModel& model, const std::vector<int>& slow) {
  const std::vector<Record> records = records_of(log, model, 0);
  std::vector<FullPrediction> predictions;
  for (const Record& r : records) predictions.push_back(predict_fully(r, {model.nominal, model.effects}));
  std::vector<JointLateness> joints;
  for (const int k : slow)
    if (const auto j = joint_lateness(records, predictions, k)) joints.push_back(*j);
  return joints;
}

/// Of the joint that tells it most precisely, of those where it explains much; 0 if there is none: a small lateness
/// explains little.
double first_estimate(std::vector<JointLateness> joints) {
  std::erase_if(joints, [](const JointLateness& j) { return !(j.explains > kExplains); });
  const auto best = std::ranges::min_element(joints, {}, &JointLateness::variance);
  return best == joints.end() ? 0 : best->delay;
}

/// What a fit of the model's numbers together with a delay of each slow sensor adds to `late`, by the joints that
/// agree; nothing if too few agree. Zero and ratio of each joint are free, as in the regression.
std::optional<double> correction(const Log& log, const ArmModel& model, const std::vector<JointLateness>& joints,
                                 double late) {
  const Evidence evidence(records_of(log, model, late), model, Split::none);
  Hypothesis h{model.nominal, model.effects};
  const std::vector<FitParameter> numbers = baseline_parameters(model);
  std::vector<FitParameter> parameters = numbers;
  std::vector<std::size_t> delays;
  const auto add = [&](const char* effect, int joint, const char* parameter) {
    if (!std::ranges::count(effect_places(*find_effect(effect), model.nominal), EffectPlace(joint))) return;
    h.effects.push_back(place_neutral_effect(*find_effect(effect), model.nominal, joint));
    for (const FitParameter& p : effect_parameters(evidence, h, model.nominal, h.effects.size() - 1)) {
      if (p.name != parameter) continue;
      if (std::string(effect) == "delay") delays.push_back(parameters.size());
      parameters.push_back(p);
    }
  };
  for (const JointLateness& j : joints) {
    add("delay", j.joint, "sensor_delay");
    add("encoder_offset", j.joint, "offset");
    add("capstan_ratio", j.joint, "ratio");
  }
  // The second fit weighs the channels by what the first one leaves.
  Fit f;
  for (int times = 0; times < 2; ++times) {
    const auto columns = sensitivities(evidence, h, numbers);
    if (columns.size() != numbers.size()) return std::nullopt;
    f = fit(evidence, h, parameters, channel_scale(evidence, evidence.score(h).fit_mean_square), {}, columns);
    if (!f.usable) return std::nullopt;
    h = f.hypothesis;
  }
  std::vector<JointLateness> left;
  for (const std::size_t i : delays)
    left.push_back({.delay = f.value[i], .variance = f.std_deviation[i] * f.std_deviation[i]});
  left = agreeing(std::move(left));
  if (left.empty()) return std::nullopt;
  return weighted_mean(left, kSettled);
}

}  // namespace

std::optional<ArmModel> model_for_lateness(const std::vector<Log>& logs, const ArmModel& given,
                                           const Hypothesis& found) {
  constexpr int kCommandDelay = 0;
  const auto is_of_all_sensors = [&](const PlacedEffect& e) {
    return e.effect->name() == "delay" && (e.joint == kWholeArm || given.n() == 1) && e.p[kCommandDelay] == 0;
  };
  const auto first = found.effects.begin();
  const auto delay = std::find_if(first + std::ssize(given.effects), found.effects.end(), is_of_all_sensors);
  if (delay == found.effects.end()) return std::nullopt;
  bool any_slow = false;
  for (const Log& log : logs) {
    const std::vector<int> stuck = stuck_joint_sensors(log, given);
    for (int k = 0; k < given.n(); ++k) {
      // What is not compared tells no lateness.
      if (given.nominal.joint[k].drive == Drive::none || std::ranges::count(stuck, k) > 0) continue;
      if (log.joint_position[k].empty()) continue;
      if (!has_slow_joint_sensor(log, given, k)) return std::nullopt;
      any_slow = true;
    }
  }
  if (!any_slow) return std::nullopt;
  ArmModel model = given;
  model.nominal = found.nominal;
  model.effects = found.effects;
  model.effects.erase(model.effects.begin() + (delay - first));
  std::erase_if(model.effects, [&](const PlacedEffect& e) { return is_event(e, given.nominal); });
  return model;
}

std::optional<double> slow_sensor_lateness(const Log& log, const ArmModel& model) {
  std::vector<int> slow;
  for (int k = 0; k < model.n(); ++k)
    if (has_slow_joint_sensor(log, model, k)) slow.push_back(k);
  if (slow.empty()) return 0;
  if (log.duration() < kBlock * kFewestBlocks) return std::nullopt;
  const std::vector<JointLateness> joints = regressed(log, model, slow);
  double late = first_estimate(joints);
  for (int pass = 0; pass < kPasses && !joints.empty(); ++pass) {
    const std::optional<double> more = correction(log, model, joints, late);
    if (!more) return 0;
    late += *more;
    if (std::abs(late) > kLongestLateness) return 0;
    if (std::abs(*more) < kSettled) break;
  }
  return std::abs(late) < kLeastTold ? 0 : late;
}

}  // namespace halyard
