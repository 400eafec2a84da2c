#pragma once
/// Whether a filter knows how far off it is (Bar-Shalom, Li and Kirubarajan 2001, section 5.4).
///
///   NIS      νᵀ S⁻¹ ν / m                ν innovation of m readings, S what the filter says of its covariance
///   NEES_k   (e_k / σ_k)²                 e_k error of joint k's position, σ_k what the filter says of it
///
/// Both are 1 in the mean if the filter is right. How far a mean may be off 1 by chance is told by χ²(N) / N, N the
/// independent samples in it: those of a run that follow each other are counted by their autocorrelation.

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

/// A mean that ought to be 1, and where 95 % of such means lie.
struct Consistency {
  double mean = 0;  ///< NaN without samples
  double lower = 0, upper = 0;
  double samples = 0;  ///< that say something of their own
  Confidence confidence() const;
};

/// Of the squares of one run: NIS or NEES, NaN where there is none.
Consistency consistency(std::span<const double> squares);
/// Of the squares of runs that are independent of each other, each with its own mean and effective samples.
Consistency consistency_of_runs(std::span<const Consistency> runs);

/// How white innovations are: what is predictable in them the filter has missed.
struct Whiteness {
  double correlation = 0;  ///< of neighbours, ρ_1
  double with_torque = 0;  ///< largest correlation with the motor's torque of the 20 samples before
  double chance = 0;       ///< neither lies beyond this by chance at the 95 % level, 40 looks respected
  bool is_white() const;
};
/// innovation, torque: one entry a sample of the record, NaN where there is none.
Whiteness whiteness(std::span<const double> innovation, std::span<const double> torque);

/// (e / σ)² of each sample; NaN where error or deviation is missing.
std::vector<double> normalised_squares(std::span<const double> estimate, std::span<const double> truth,
                                       std::span<const double> std_deviation);

/// "consistent", "too sure: errors are 2.1 times what it says", "too cautious: ...", "says nothing of its errors".
std::string in_words(const Consistency& c);
std::string in_words(const Whiteness& w);

}  // namespace halyard
