#include "diagnosis/holdout/prediction_interval.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "diagnosis/judgement/final_fit.h"
#include "model/statistics/quantile.h"

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

/// s_i of every sample, from its sensitivities.
std::vector<double> deviations(const Fit& fit, const Eigen::MatrixXd& g) {
  std::vector<double> s(static_cast<std::size_t>(g.rows()), 0);
  if (g.cols() == 0) return s;
  for (const Eigen::MatrixXd* covariance : {&fit.covariance, &fit.block_covariance}) {
    const Eigen::VectorXd square = (g * *covariance).cwiseProduct(g).rowwise().sum();
    for (std::size_t i = 0; i < s.size(); ++i)
      if (const double of_fit = square(static_cast<Eigen::Index>(i)); std::isnan(of_fit)) s[i] = of_fit;
      else s[i] = std::max(s[i], std::sqrt(std::max(0.0, of_fit)));
  }
  return s;
}

}  // namespace

std::vector<double> residual_quantiles(const Evidence& evidence, const std::vector<Record>& training,
                                       const Hypothesis& hypothesis) {
  std::vector<std::vector<double>> size(evidence.n());
  for (const Record& record : training) {
    if (!record.place) continue;
    const double of_evidence = record.dt / evidence.records()[*record.place].dt;
    const FullPrediction prediction = predict_fully(record, hypothesis);
    for (std::size_t i = 0; i < record.size; ++i) {
      if (!evidence.decides(*record.place, static_cast<std::size_t>(of_evidence * static_cast<double>(i)))) continue;
      for (int k = 0; k < evidence.n(); ++k) size[k].push_back(std::abs(joint_error(record, prediction, k, i)));
    }
  }
  std::vector<double> quantiles;
  for (std::vector<double>& of_joint : size) quantiles.push_back(quantile(std::move(of_joint), kIntervalShare));
  return quantiles;
}

Fit with_all_numbers(const Evidence& whole, const Fit& fit, const std::vector<FitParameter>& numbers) {
  std::vector<FitParameter> all = numbers;
  std::erase_if(all, [](const FitParameter& p) { return p.effect.has_value(); });
  std::ranges::copy_if(fit.parameters, std::back_inserter(all),
                       [](const FitParameter& p) { return p.effect.has_value(); });
  const std::vector<double> scale = channel_scale(whole, whole.score(fit.hypothesis).fit_mean_square);
  return halyard::fit(whole, fit.hypothesis, all, scale,
                      {.iterations = 0, .correlated_rows = independent_rows(whole, scale)});
}

Fit without_event(Fit fit, std::size_t effect) {
  std::vector<Eigen::Index> kept;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
    if (fit.parameters[i].effect != effect) kept.push_back(static_cast<Eigen::Index>(i));
  for (std::vector<double>* of_parameter : {&fit.value, &fit.std_deviation}) {
    std::vector<double> left;
    for (const Eigen::Index i : kept) left.push_back((*of_parameter)[static_cast<std::size_t>(i)]);
    *of_parameter = std::move(left);
  }
  for (Eigen::MatrixXd* covariance : {&fit.covariance, &fit.block_covariance})
    *covariance = Eigen::MatrixXd((*covariance)(kept, kept));
  fit.parameters = without_parameters_of(fit.parameters, effect);
  fit.hypothesis = without_effect(fit.hypothesis, effect);
  return fit;
}

std::vector<Signals> half_widths(const std::vector<Record>& records, const Fit& fit,
                                 const std::vector<double>& quantile) {
  const Steps steps(fit);
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
      const std::vector<double> s = deviations(fit, channel_sensitivities(residuals, steps.size, record.n + k));
      for (std::size_t i = 0; i < record.size; ++i) half[k][i] = std::hypot(t * s[i], quantile[k]);
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
