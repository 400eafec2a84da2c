#include "diagnosis/explanation/signature.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/explanation/view_sentence.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

/// Joint k's motion as the motors tell it, or its sensor if it has no motor, every stride-th sample.
std::vector<double> joint_motion(const Record& record, const ArmParameters<double>& arm, int k, int stride) {
  std::vector<double> y;
  for (std::size_t i = 0; i < record.size; i += stride) {
    Eigen::VectorXd q_m(record.n);
    for (int j = 0; j < record.n; ++j) q_m(j) = record.motor_angle[j][i];
    y.push_back(unstretched_joints(arm, q_m, q_m)(k));
  }
  return y;
}

}  // namespace

std::string signature(const Evidence& evidence, const Hypothesis& hypothesis, int joint) {
  std::vector<FullPrediction> predictions;
  for (const Record& record : evidence.records()) predictions.push_back(predict_fully(record, hypothesis));
  const ResidualSignals rest = residual_signals(evidence.records(), predictions, hypothesis, joint);
  const std::vector<View> views = telling_views(rest);
  std::string text;
  for (const ResidualKind kind : {ResidualKind::joint_position, ResidualKind::motor_torque}) {
    const int channel = kind == ResidualKind::joint_position ? evidence.n() + joint : joint;
    if (rest.of(kind).empty() || !evidence.has_channel(channel)) continue;
    double square = 0, count = 0;
    for (const double y : rest.of(kind))
      if (std::isfinite(y)) square += y * y, count += 1;
    if (count == 0) continue;
    const double rms = std::sqrt(square / count), floor = evidence.floor()[channel];
    if (rms <= floor) continue;
    const bool is_noise = floor > evidence.resolved()[channel];
    const ArmParameters<double>& arm = hypothesis.nominal;
    text += fmt::format("{}the {}, {} RMS, is {:.1f} times {}, and ", text.empty() ? "" : "; ",
                        residual_name(arm, joint, kind), shown(rms, residual_unit(arm, joint, kind)), rms / floor,
                        is_noise ? "its sensor's noise" : "what its sensor resolves");
    const auto view = std::find_if(views.begin(), views.end(), [&](const View& v) { return v.residual == kind; });
    text += view == views.end() ? "no dependence of it on direction, position, rate, load, angle or time can be shown"
                                : view_phrase(*view, arm, joint);
  }
  return text;
}

bool stands_still(const Record& record, const ArmParameters<double>& arm, int joint) {
  std::size_t moving = 0;
  for (const double rate : record.motor_rate[joint]) moving += std::abs(rate) > 2 * arm.joint[joint].motor_smoothing;
  return static_cast<double>(moving) < 0.05 * static_cast<double>(record.size);
}

bool is_one_sinusoid(const std::vector<Record>& records, const ArmParameters<double>& arm, int joint) {
  if (records.size() != 1) return false;
  const Record& record = records.front();
  if (stands_still(record, arm, joint)) return true;
  const int stride = std::max(1, static_cast<int>(0.02 / record.dt));
  // Sines are often faded in: what counts is how the motion goes on.
  std::vector<double> motion = joint_motion(record, arm, joint, stride);
  motion.erase(motion.begin(), motion.begin() + static_cast<std::ptrdiff_t>(motion.size() / 3));
  // Of the rate: a to and fro at constant speed has 98 % of its position in one sine, too, but other speeds and loads.
  for (std::size_t i = 0; i + 1 < motion.size(); ++i) motion[i] = motion[i + 1] - motion[i];
  motion.pop_back();
  std::vector<double> time;
  for (std::size_t i = 0; i < motion.size(); ++i) time.push_back(record.dt * stride * static_cast<double>(i));
  // 16 frequencies to a resolution cell: between two of them a pure sine still has 99.7 % of its power, with four it
  // would have 95 %.
  const double cell = 1 / (record.dt * stride * static_cast<double>(motion.size()));
  return strongest_line(spectrum(time, motion, 0.5 * cell, 5, cell / 16)).share > 0.98;
}

}  // namespace halyard
