#pragma once
/// Consistency of a filter with its stated covariances (Bar-Shalom, Li and Kirubarajan 2001, section 5.4).
///
///   NIS      νᵀ S⁻¹ ν / m                ν: innovation of m readings, S: its covariance as the filter states it
///   NEES_k   (e_k / σ_k)²                 e_k: error of joint k's position, σ_k: its stated standard deviation
///
/// Both have the mean 1 if the filter is consistent. Means of N independent samples have the distribution χ²(m N) /
/// (m N); NEES has m = 1. Successive samples of a run are correlated: N is reduced according to their autocorrelation.

#include <span>
#include <string>
#include <vector>

#include "evaluation/judgement/serial_statistics.h"

namespace halyard {

/// How an estimator's errors compare with the standard deviations that it states.
enum class Confidence {
  unstated,       ///< it states none
  consistent,     ///< the mean lies in its band
  overconfident,  ///< errors are larger than stated
  underconfident  ///< errors are smaller than stated
};

/// A mean that should be 1, and the band in which 95 % of such means lie.
struct Consistency {
  double mean = 0;  ///< NaN without samples
  double lower = 0, upper = 0;
  double samples = 0;   ///< number of independent samples, N
  double readings = 1;  ///< of a sample, m; the harmonic mean where it varies
  Confidence confidence() const;
};

/// Consistency of one run; squares: NIS or NEES of each sample, NaN where there is none. readings: m.
Consistency consistency(std::span<const double> squares, double readings = 1);
/// Consistency of independent runs together, each given by its mean and number of independent samples.
Consistency consistency_of_runs(std::span<const Consistency> runs);

/// Whiteness of innovations. A correlation shows information that the filter did not use.
struct Whiteness {
  double correlation = 0;  ///< of successive innovations, ρ_1
  double with_torque = 0;  ///< largest correlation with the motor's torque, over lags of up to 20 innovations
  /// bound that the correlations of white innovations exceed with probability 5 %, corrected for 40 tests
  double chance = 0;
  bool is_white() const;
};
/// innovation, torque: one entry for each sample of the record, NaN where there is none. Samples without an innovation,
/// such as those between two readings of the motor, do not count.
Whiteness whiteness(std::span<const double> innovation, std::span<const double> torque);

/// (e / σ)² of each sample; NaN where error or deviation is missing.
std::vector<double> normalised_squares(std::span<const double> estimate, std::span<const double> truth,
                                       std::span<const double> std_deviation);

/// The result as a phrase for reports.
std::string in_words(const Consistency& c);
std::string in_words(const Whiteness& w);

}  // namespace halyard
