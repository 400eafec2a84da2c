#include "diagnosis/signature.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "transmission/path_matrix.h"

namespace halyard {
namespace {

struct Regressor { const char* name; std::vector<double> value; };

/// Share of the variance of y that a regressor explains beyond a constant; of the constant itself, the share of the
/// mean square.
double explained(const std::vector<double>& y, const std::vector<double>& x) {
  double my = 0, mx = 0;
  for (std::size_t i = 0; i < y.size(); ++i) my += y[i] / y.size(), mx += x[i] / x.size();
  double xy = 0, xx = 0, yy = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    xy += (x[i] - mx) * (y[i] - my);
    xx += (x[i] - mx) * (x[i] - mx);
    yy += y[i] * y[i];
  }
  if (xx <= 0) return yy > 0 ? my * my * y.size() / yy : 0;
  return yy > 0 ? xy * xy / xx / yy : 0;
}

/// Joint k's motion as the motors tell it, every stride-th sample.
std::vector<double> joint_motion(const Record& record, const ArmParameters<double>& arm, int k, int stride) {
  const Eigen::VectorXd undriven = Eigen::VectorXd::Zero(record.n);
  std::vector<double> y;
  for (std::size_t i = 0; i < record.size; i += stride) {
    Eigen::VectorXd q_m(record.n);
    for (int j = 0; j < record.n; ++j) q_m(j) = record.motor_angle[j][i];
    y.push_back(unstretched_joints(arm, q_m, undriven)(k));
  }
  return y;
}

/// True if the motor hardly ever turns fast enough for its friction to have a direction.
bool stands_still(const Record& record, const ArmParameters<double>& arm, int k) {
  std::size_t moving = 0;
  for (const double rate : record.motor_rate[k]) moving += std::abs(rate) > 2 * arm.joint[k].motor_smoothing;
  return static_cast<double>(moving) < 0.05 * static_cast<double>(record.size);
}

/// Share of the power of a motion, its mean removed, in its strongest line and that line's neighbours.
struct Line { double share = 0, frequency = 0, amplitude = 0; };

Line strongest_line(std::vector<double> y, double dt) {
  const double n = static_cast<double>(y.size());
  double mean = 0, power = 0;
  for (const double v : y) mean += v / n;
  for (double& v : y) v -= mean, power += v * v / n;
  Line best;
  if (power <= 0) return best;
  // Least squares of one sine at each of a grid of frequencies, 16 to a resolution cell: between two of them a pure sine
  // still has 99.7 % of its power, with four it would have 95 %.
  for (double f = 0.5 / (n * dt); f < 5; f += 1 / (16 * n * dt)) {
    Eigen::MatrixXd A(y.size(), 3);
    Eigen::VectorXd b(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double phase = 2 * std::numbers::pi * f * dt * static_cast<double>(i);
      A.row(i) << std::cos(phase), std::sin(phase), 1;
      b(i) = y[i];
    }
    const Eigen::Vector3d c = (A.transpose() * A).ldlt().solve(A.transpose() * b);
    const double share = 1 - (b - A * c).squaredNorm() / (n * power);
    if (share > best.share) best = {share, f, std::hypot(c(0), c(1))};
  }
  return best;
}

}  // namespace

std::string signature(const Evidence& evidence, const Hypothesis& hypothesis, int joint) {
  const int n = evidence.n();
  std::string text;
  for (const bool of_joint : {true, false}) {
    const int c = of_joint ? n + joint : joint;
    if (!evidence.has_channel(c)) continue;
    std::vector<double> y, constant;
    std::vector<Regressor> regressors = {{"a constant", {}}, {"position", {}}, {"rate", {}}, {"direction of motion", {}}, {"acceleration", {}}};
    double square = 0;
    for (const Record& record : evidence.records()) {
      const int stride = std::max(1, static_cast<int>(0.02 / record.dt));
      const Residuals r = predict(record, {hypothesis}, stride)[0];
      if (r.channel[c].empty()) continue;
      for (std::size_t i = 0; i < r.channel[c].size(); ++i) {
        if (!std::isfinite(r.channel[c][i])) continue;
        const std::size_t at = i * stride;
        y.push_back(r.channel[c][i]);
        square += y.back() * y.back();
        const double rate = record.motor_rate[joint][at];
        regressors[0].value.push_back(1);
        regressors[1].value.push_back(record.motor_angle[joint][at]);
        regressors[2].value.push_back(rate);
        regressors[3].value.push_back(rate > 0 ? 1 : -1);
        regressors[4].value.push_back(record.motor_acceleration[joint][at]);
      }
    }
    if (y.empty()) continue;
    const Regressor* most = nullptr;
    double share = 0;
    for (const Regressor& g : regressors)
      if (const double e = explained(y, g.value); e > share) share = e, most = &g;
    const double rms = std::sqrt(square / static_cast<double>(y.size()));
    if (!text.empty()) text += "; ";
    const bool turns = hypothesis.nominal.joint[joint].type == JointType::revolute;
    text += fmt::format("{} residual {:.3g} {} RMS, {:.1f} times its floor", of_joint ? "joint" : "torque", rms,
                        of_joint ? (turns ? "rad" : "m") : "N m", rms / evidence.floor()[c]);
    constexpr double kGoesWith = 0.2;
    if (most && share > kGoesWith)
      text += fmt::format(", goes with {} ({:.0f} % of it)", most->name, 100 * share);
    else
      text += ", goes with none of position, rate, direction and acceleration";
  }
  return text;
}

bool is_one_sinusoid(const std::vector<Record>& records, const ArmParameters<double>& arm, int joint) {
  if (records.size() != 1) return false;
  const Record& record = records.front();
  if (stands_still(record, arm, joint)) return true;
  const int stride = std::max(1, static_cast<int>(0.02 / record.dt));
  // Sines are often faded in: what counts is how the motion goes on.
  std::vector<double> motion = joint_motion(record, arm, joint, stride);
  motion.erase(motion.begin(), motion.begin() + static_cast<std::ptrdiff_t>(motion.size() / 3));
  return strongest_line(std::move(motion), record.dt * stride).share > 0.98;
}

}  // namespace halyard
