#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "evaluation/sweep/sweep_cells.h"
#include "evaluation/sweep/sweep_grid.h"

namespace halyard {

/// Mean of independent numbers with its 95 % interval: mean ± t s / sqrt(n), t the 97.5th percentile of Student's
/// distribution with n - 1 degrees of freedom, s² = Σ(x - mean)² / (n - 1). Welford's recursion (Technometrics 4,
/// 1962).
class MeanWithInterval {
 public:
  /// NaN does not count.
  void add(double x);
  std::size_t count() const { return n_; }
  double mean() const;                           ///< NaN without numbers
  double half_width() const;                     ///< NaN with fewer than two numbers
  double least() const { return least_; }        ///< infinity without numbers
  double greatest() const { return greatest_; }  ///< -infinity without numbers

 private:
  std::size_t n_ = 0;
  double mean_ = 0, squares_ = 0;
  double least_ = std::numeric_limits<double>::infinity(), greatest_ = -least_;
};

/// What a report says of all points of a sweep, collected from one cell after the other; its size does not grow with
/// the number of points.
class SweepSummary {
 public:
  explicit SweepSummary(const SweepGrid& grid);

  /// The cells of all points, in their order.
  void add(const SweepCell& cell);

  std::size_t failures = 0;  ///< results with a failure

  /// Smallest and largest value that a measure shows of a subject at a joint.
  struct Span {
    double least = std::numeric_limits<double>::infinity(), greatest = 0;
  };
  std::vector<std::vector<std::vector<Span>>> spans;  ///< [n_measures][n_subjects][n_joints]

  /// The most values of a grid's axis that have a place each.
  static constexpr std::size_t kMostPlaces = 200;

  /// What a measure shows over one axis, averaged over everything else. An axis with at most kMostPlaces values, or 40
  /// of samples, has one place for each, in increasing order; the range of other axes is divided into 20 equal bins.
  /// Repeats of a sample count as one number, their mean.
  struct Curve {
    std::vector<double> x;                ///< values, or centres of the bins
    std::vector<MeanWithInterval> means;  ///< [x.size()], in SI units
  };
  const Curve& curve(std::size_t measure, std::size_t axis, std::size_t subject, std::size_t joint) const;

 private:
  /// The places of an axis.
  struct Places {
    std::vector<double> centres, edges;  ///< edges: upper ends
  };
  static Places places_of(const SweepAxis& axis, std::size_t most);
  MeanWithInterval& mean_at(std::size_t measure, std::size_t axis, std::size_t subject, std::size_t joint,
                            double value);
  std::size_t index(std::size_t measure, std::size_t axis, std::size_t subject, std::size_t joint) const;

  SweepGrid grid_;
  std::vector<Places> places_;             ///< [n_axes]
  std::vector<Curve> curves_;              ///< [n_measures * n_axes * n_subjects * n_joints]
  std::vector<MeanWithInterval> repeats_;  ///< of the present sample, [n_measures * n_subjects * n_joints]
};

}  // namespace halyard
