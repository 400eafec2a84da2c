#pragma once
/// A first look at a candidate, to first order: which share of the residual that the baseline's numbers cannot take
/// could one of the candidate's directions take?
///
///   r⊥ = r - J (Jᵀ J + P)⁻¹ Jᵀ r,  d⊥ likewise,  promise = (r⊥ · d⊥)² / (|r⊥|² |d⊥|²)
///
///   r   residual of the fitting rows, each channel over its scale            [rows]
///   J   its sensitivities to the baseline's numbers, P their prior            [rows x numbers]
///   d   what the candidate at some size changes of r                          [rows]

#include <Eigen/QR>

#include "diagnosis/fit.h"

namespace halyard {

class Screen {
 public:
  /// columns: sensitivities() at the hypothesis, one a baseline number.
  Screen(const Evidence& evidence, const Hypothesis& at, const std::vector<std::vector<double>>& columns,
         const std::vector<double>& scale);

  /// What a candidate's change d of the residual could do.
  struct Direction {
    double promise = 0;  ///< 0 to 1
    double amount = 0;   ///< how many times d takes most of the residual: -(r⊥ · d⊥) / |d⊥|²
  };
  /// rows: what the candidate at some size leaves; empty rows promise nothing.
  Direction direction(const std::vector<double>& rows) const;
  /// |r⊥ + d⊥|², infinite for empty rows.
  double left(const std::vector<double>& rows) const;
  /// Instants at which r leaps (leaps.h).
  const std::vector<double>& instants() const { return instants_; }

 private:
  Eigen::VectorXd weighted(const std::vector<double>& rows) const;
  /// The part of x that the baseline's numbers cannot take.
  Eigen::VectorXd beyond_baseline(Eigen::VectorXd x) const;

  const Evidence& evidence_;
  std::vector<double> scale_;
  int numbers_;
  Eigen::HouseholderQR<Eigen::MatrixXd> qr_;
  Eigen::VectorXd r_, r_beyond_;
  std::vector<double> instants_;
};

}  // namespace halyard
