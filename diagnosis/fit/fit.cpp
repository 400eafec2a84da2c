#include "diagnosis/fit/fit.h"

#include <ceres/cost_function.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "diagnosis/fit/block_variance.h"
#include "diagnosis/fit/bounded_least_squares.h"

namespace halyard {
namespace {

class Residual : public ceres::CostFunction {
 public:
  Residual(const Evidence& evidence, const Hypothesis& start, const std::vector<FitParameter>& parameters,
           const std::vector<double>& scale, const std::vector<double>& correlated_rows,
           const std::vector<std::vector<double>>& linear)
      : evidence_(evidence), start_(start), parameters_(parameters), linear_(linear) {
    for (const int c : evidence.row_channel()) weight_.push_back(1 / (scale[c] * std::sqrt(correlated_rows[c])));
    for (std::size_t i = 0; i < parameters.size(); ++i)
      if (!parameters[i].effect) prior_.push_back(static_cast<int>(i));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(parameters.size()));
    set_num_residuals(static_cast<int>(weight_.size() + prior_.size()));
  }

  Hypothesis hypothesis(const double* u) const {
    Hypothesis h = start_;
    for (std::size_t i = 0; i < parameters_.size(); ++i)
      if (!is_linear(i)) set_parameter(h, parameters_[i], u[i] * parameters_[i].scale + origin(i));
    return h;
  }
  /// Value of the optimiser's zero: the model's number for a baseline parameter, 0 for an effect's.
  double origin(std::size_t i) const { return parameters_[i].effect ? 0 : parameters_[i].nominal; }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const double* u = blocks[0];
    const std::size_t rows = weight_.size(), p = parameters_.size();
    const bool wanted = jacobians && jacobians[0];
    // A few sensitivities ride in the lanes beside the value.
    const bool few = p - linear_.size() < kLaneWidth;
    std::vector<Hypothesis> all = {hypothesis(u)};
    std::vector<double> step(p, 0);
    for (std::size_t i = 0; (wanted || few) && i < p; ++i) {
      if (is_linear(i)) continue;
      all.push_back(stepped(all[0], parameters_[i]));
      step[i] = (parameter_value(all.back(), parameters_[i]) - parameter_value(all[0], parameters_[i])) /
                parameters_[i].scale;
    }
    // What is linear moves no hypothesis.
    std::vector<double> point;
    for (std::size_t i = 0; i < p; ++i)
      if (!is_linear(i)) point.push_back(u[i]);
    if (last_point_ != point || last_.size() < all.size()) {
      last_ = evidence_.fit_rows(all);
      last_point_ = point;
    }
    const auto& out = last_;
    for (const auto& column : out)
      if (column.empty()) return false;

    std::vector<double> base = out[0];
    for (std::size_t i = 0; i < linear_.size(); ++i) {
      const double by = u[i] - (parameter_value(start_, parameters_[i]) - origin(i)) / parameters_[i].scale;
      for (std::size_t r = 0; r < rows; ++r) base[r] += by * linear_[i][r];
    }
    for (std::size_t r = 0; r < rows; ++r) residuals[r] = weight_[r] * base[r];
    for (std::size_t i = 0; i < prior_.size(); ++i) residuals[rows + i] = u[prior_[i]];
    if (!wanted) return true;

    double* J = jacobians[0];
    std::fill(J, J + (rows + prior_.size()) * p, 0.0);
    for (std::size_t i = 0, column = 1; i < p; ++i) {
      if (is_linear(i)) {
        for (std::size_t r = 0; r < rows; ++r) J[r * p + i] = weight_[r] * linear_[i][r];
      } else {
        for (std::size_t r = 0; r < rows; ++r) J[r * p + i] = weight_[r] * (out[column][r] - out[0][r]) / step[i];
        ++column;
      }
    }
    for (std::size_t i = 0; i < prior_.size(); ++i) J[(rows + i) * p + prior_[i]] = 1;
    // Ceres would print numbers that are not finite, whatever its options say.
    return std::all_of(J, J + (rows + prior_.size()) * p, [](double d) { return std::isfinite(d); });
  }

 private:
  bool is_linear(std::size_t i) const { return i < linear_.size(); }

  const Evidence& evidence_;
  const Hypothesis& start_;
  const std::vector<FitParameter>& parameters_;
  const std::vector<std::vector<double>>& linear_;  ///< [first parameters] sensitivities
  std::vector<double> weight_;
  std::vector<int> prior_;
  mutable std::vector<double> last_point_;  ///< where last_ was taken: the solver asks twice
  mutable std::vector<std::vector<double>> last_;
};

/// Bounded least squares from u on; false if the start cannot be integrated.
bool minimise(const Residual& residual, const std::vector<FitParameter>& parameters, const FitOptions& options,
              std::vector<double>& u) {
  std::vector<double> lower, upper;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const FitParameter& p = parameters[i];
    lower.push_back((p.lower - residual.origin(i)) / p.scale);
    upper.push_back((p.upper - residual.origin(i)) / p.scale);
  }
  return halyard::minimise(residual, lower, upper, {options.iterations, options.cost_tolerance}, u);
}

/// The longest correlation time of any channel in any record, in blocks.
double correlated_blocks(const Evidence& evidence, const Eigen::VectorXd& r) {
  double longest = 0;
  const std::vector<int>&channel = evidence.row_channel(), &record = evidence.row_record(),
        &block = evidence.row_block();
  for (std::size_t first = 0, last = 0; first < channel.size(); first = last) {
    while (last < channel.size() && channel[last] == channel[first] && record[last] == record[first]) ++last;
    const double rows = static_cast<double>(last - first), blocks = block[last - 1] - block[first] + 1;
    longest = std::max(longest, correlation_rows({r.data() + first, last - first}) / rows * blocks);
  }
  return longest;
}

/// Standard deviations and covariance at the minimum u.
bool add_deviations(const Evidence& evidence, const Residual& residual, const std::vector<double>& u, Fit& result) {
  constexpr double kCorrelationTimes = 4;  // a block is as long as so many
  constexpr int kFewestBlocks = 10;
  const LinearisedResidual end(residual, u);
  if (!end.finite) return false;
  const auto p = static_cast<Eigen::Index>(u.size());
  const auto rows = static_cast<Eigen::Index>(evidence.row_channel().size());
  const Eigen::MatrixXd J = end.J.topRows(rows);
  const Eigen::VectorXd r = Eigen::Map<const Eigen::VectorXd>(end.r.data(), rows);
  Eigen::VectorXd unit(p), prior(p);
  for (Eigen::Index i = 0; i < p; ++i) {
    unit(i) = result.parameters[i].scale;
    prior(i) = result.parameters[i].effect ? 0 : 1;
  }
  Eigen::MatrixXd information = J.transpose() * J;
  information.diagonal() += prior;
  information.diagonal().array() += 1e-9;
  result.covariance = unit.asDiagonal() * information.ldlt().solve(Eigen::MatrixXd::Identity(p, p)) * unit.asDiagonal();
  const std::vector<int> blocks =
      grouped_blocks(evidence.row_block(), kCorrelationTimes * correlated_blocks(evidence, r), kFewestBlocks);
  const BlockVariance scatter = block_variance(J, r, prior, blocks);
  result.blocks = scatter.blocks;
  result.block_covariance = unit.asDiagonal() * scatter.covariance * unit.asDiagonal();
  for (Eigen::Index i = 0; i < p; ++i) {
    const double larger = std::max(result.block_covariance(i, i), result.covariance(i, i));
    result.std_deviation.push_back(std::sqrt(std::max(0.0, larger)));
  }
  return true;
}

}  // namespace

std::vector<double> channel_scale(const Evidence& evidence, const std::vector<double>& mean_square) {
  std::vector<double> scale(evidence.channels(), 1.0);
  for (int c = 0; c < evidence.channels(); ++c)
    if (evidence.has_channel(c)) scale[c] = std::max(std::sqrt(mean_square[c]), evidence.floor()[c]);
  return scale;
}

Eigen::VectorXd row_scale(const Evidence& evidence, const std::vector<double>& scale) {
  Eigen::VectorXd rows(static_cast<Eigen::Index>(evidence.row_channel().size()));
  for (Eigen::Index r = 0; r < rows.size(); ++r)
    rows(r) = scale[evidence.row_channel()[r]] * std::sqrt(evidence.correlated_rows(evidence.row_channel()[r]));
  return rows;
}

std::vector<double> independent_rows(const Evidence& evidence, const std::vector<double>& scale) {
  std::vector<double> rows(evidence.channels(), 1.0);
  for (int c = 0; c < evidence.channels(); ++c) {
    if (!evidence.has_channel(c)) continue;
    const double square = scale[c] * scale[c], noise = std::pow(evidence.noise()[c].in_band, 2);
    const double of_model = std::max(square - noise, std::pow(evidence.resolved()[c], 2));
    rows[c] = (noise * evidence.noise_rows() + of_model * evidence.correlated_rows(c)) / square;
  }
  return rows;
}

std::vector<std::vector<double>> sensitivities(const Evidence& evidence, const Hypothesis& at,
                                               const std::vector<FitParameter>& parameters) {
  std::vector<Hypothesis> all = {at};
  for (const FitParameter& p : parameters) all.push_back(stepped(at, p));
  auto rows = evidence.fit_rows(all);
  for (const auto& r : rows)
    if (r.empty()) return {};
  std::vector<std::vector<double>> columns;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double step =
        (parameter_value(all[i + 1], parameters[i]) - parameter_value(at, parameters[i])) / parameters[i].scale;
    for (std::size_t r = 0; r < rows[0].size(); ++r) rows[i + 1][r] = (rows[i + 1][r] - rows[0][r]) / step;
    columns.push_back(std::move(rows[i + 1]));
  }
  return columns;
}

Fit fit(const Evidence& evidence, const Hypothesis& start, const std::vector<FitParameter>& all,
        const std::vector<double>& scale, const FitOptions& options, const std::vector<std::vector<double>>& linear) {
  Fit result;
  std::vector<FitParameter> parameters = all;
  std::erase_if(parameters, [](const FitParameter& p) { return p.is_whole; });
  result.parameters = parameters;
  result.hypothesis = start;
  if (parameters.empty()) {
    result.usable = true;
    return result;
  }
  std::vector<double> correlated_rows = options.correlated_rows;
  if (correlated_rows.empty())
    for (int c = 0; c < evidence.channels(); ++c) correlated_rows.push_back(evidence.correlated_rows(c));
  Residual residual(evidence, start, parameters, scale, correlated_rows, linear);
  std::vector<double> u;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    u.push_back((parameter_value(start, parameters[i]) - residual.origin(i)) / parameters[i].scale);
  if (!minimise(residual, parameters, options, u)) return result;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    result.value.push_back(u[i] * parameters[i].scale + residual.origin(i));
    set_parameter(result.hypothesis, parameters[i], result.value.back());
  }
  result.usable = add_deviations(evidence, residual, u, result);
  return result;
}

}  // namespace halyard
