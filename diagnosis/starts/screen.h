#pragma once
/// A linear screening of candidates. r⊥ is the part of the residual that the baseline's parameters cannot explain
/// (beyond_numbers.h). Which share of it could a candidate explain?
///
///   promise = (r⊥ · d⊥)² / (|r⊥|² |d⊥|²)
///
///   r   residual of the fitting rows                     [rows]
///   d   change of r by the candidate at some size        [rows]

#include "diagnosis/fit/beyond_numbers.h"

namespace halyard {

class Screen {
 public:
  /// columns: sensitivities() at the hypothesis, one for each baseline parameter.
  Screen(const Evidence& evidence, const Hypothesis& at, const std::vector<std::vector<double>>& columns,
         const std::vector<double>& scale);

  /// The benefit of a candidate's change d of the residual.
  struct Direction {
    double promise = 0;  ///< 0 to 1
    double amount = 0;   ///< the multiple of d that minimises the residual: -(r⊥ · d⊥) / |d⊥|²
  };
  /// rows: residual with the candidate at some size; for empty rows the promise is 0.
  Direction direction(const std::vector<double>& rows) const;
  /// |r⊥ + d⊥|², infinite for empty rows.
  double left(const std::vector<double>& rows) const { return beyond_.left(rows); }
  /// Instants at which r jumps (leaps.h).
  const std::vector<double>& instants() const { return instants_; }

 private:
  BeyondNumbers beyond_;
  Eigen::VectorXd r_, r_beyond_;
  std::vector<double> instants_;
};

}  // namespace halyard
