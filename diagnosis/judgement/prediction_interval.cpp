#include "diagnosis/judgement/prediction_interval.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/judgement/final_fit.h"
#include "diagnosis/log_check/robust.h"

namespace halyard {
namespace {

constexpr double kIntervalShare = 0.95;

/// The fit's hypothesis, then that hypothesis with each parameter moved by one step.
struct Steps {
  explicit Steps(const Fit& fit) : hypotheses{fit.hypothesis} {
    for (const FitParameter& p : fit.parameters) {
      hypotheses.push_back(stepped(fit.hypothesis, p));
      size.push_back(parameter_value(hypotheses.back(), p) - parameter_value(fit.hypothesis, p));
    }
  }

  std::vector<Hypothesis> hypotheses;
  std::vector<double> size;  ///< [p], units of the parameters
};

/// g_i of every sample of a channel, [size x p].
Eigen::MatrixXd channel_sensitivities(const std::vector<Residuals>& residuals, const std::vector<double>& step, int c) {
  const std::vector<double>& at = residuals[0].channel[c];
  Eigen::MatrixXd g(at.size(), step.size());
  for (std::size_t p = 0; p < step.size(); ++p)
    for (std::size_t i = 0; i < at.size(); ++i)
      g(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(p)) =
          (at[i] - residuals[p + 1].channel[c][i]) / step[p];
  return g;
}

}  // namespace

Eigen::MatrixXd parameter_covariance(const Fit& fit) {
  const auto p = static_cast<Eigen::Index>(fit.std_deviation.size());
  Eigen::VectorXd larger(p);
  for (Eigen::Index i = 0; i < p; ++i) {
    const double by_curvature = std::sqrt(fit.covariance(i, i));
    larger(i) = by_curvature > 0 ? fit.std_deviation[static_cast<std::size_t>(i)] / by_curvature : 0;
  }
  return larger.asDiagonal() * fit.covariance * larger.asDiagonal();
}

std::vector<double> residual_quantiles(const Evidence& evidence, const Hypothesis& hypothesis) {
  std::vector<std::vector<double>> size(evidence.n());
  for (std::size_t r = 0; r < evidence.records().size(); ++r) {
    Record unfiltered = evidence.records()[r];
    unfiltered.compare = {1};
    const FullPrediction prediction = predict_fully(unfiltered, hypothesis);
    for (int k = 0; k < evidence.n(); ++k)
      for (std::size_t i = 0; i < unfiltered.size; ++i)
        if (evidence.decides(static_cast<int>(r), i))
          size[k].push_back(std::abs(joint_error(unfiltered, prediction, k, i)));
  }
  std::vector<double> quantiles;
  for (std::vector<double>& of_joint : size) quantiles.push_back(quantile(std::move(of_joint), kIntervalShare));
  return quantiles;
}

std::vector<Signals> half_widths(const std::vector<Record>& records, const Fit& fit,
                                 const std::vector<double>& quantile) {
  const Steps steps(fit);
  const Eigen::MatrixXd C = parameter_covariance(fit);
  const double t = interval_factor(fit);
  std::vector<Signals> all;
  for (const Record& record : records) {
    const std::vector<Residuals> residuals = predict(record, steps.hypotheses, 1);
    const bool known = fit.usable && std::ranges::all_of(residuals, &Residuals::finite);
    Signals& half = all.emplace_back(record.n);
    for (int k = 0; k < record.n; ++k) {
      if (!record.has_joint(k)) continue;
      half[k].assign(record.size, std::numeric_limits<double>::quiet_NaN());
      if (!known) continue;
      const Eigen::MatrixXd g = channel_sensitivities(residuals, steps.size, record.n + k);
      const Eigen::VectorXd square = (g * C).cwiseProduct(g).rowwise().sum();
      for (std::size_t i = 0; i < record.size; ++i)
        half[k][i] = std::hypot(t * std::sqrt(std::max(0.0, square(static_cast<Eigen::Index>(i)))), quantile[k]);
    }
  }
  return all;
}

PredictionInterval prediction_interval(const HoldOut& joints, int n) {
  PredictionInterval interval;
  for (int k = 0; k < n; ++k) {
    std::vector<double> widths;
    double inside = 0;
    for (std::size_t r = 0; r < joints.records.size(); ++r)
      for (std::size_t i = 0; i < joints.records[r].size; ++i) {
        const double e = joint_error(joints.records[r], joints.after[r], k, i);
        if (std::isnan(e)) continue;
        const double half = joints.half_width[r][k][i];
        if (std::isnan(half)) continue;
        widths.push_back(half);
        inside += std::abs(e) <= half;
      }
    interval.coverage.push_back(inside / static_cast<double>(widths.size()));
    interval.half_width.push_back(median(std::move(widths)));
  }
  return interval;
}

}  // namespace halyard
