#pragma once
/// The part of a change of the residual that the baseline's parameters within their tolerances can explain, alone or
/// together with the sizes of an effect:
///
///   minimise  |x - J u - E a|² + |u|²,   |u_i| <= 2,   lower <= a <= upper
///
///   x   change of the fitting rows, weighted: each channel over its scale and √m                      [rows]
///   J   sensitivities to the baseline's parameters, weighted, per half tolerance (the prior)          [rows x numbers]
///   E   sensitivities to an effect's sizes, weighted                                                  [rows x sizes]
///
/// This is fit.h's problem to first order. Source of the bounded minimum: Bertsekas, Projected Newton methods, SIAM J.
/// Control Optim. 20 (1982).

#include <Eigen/Core>

#include "diagnosis/fit/fit.h"

namespace halyard {

/// Minimum of ½ uᵀ A u - bᵀ u, lower <= u <= upper; A positive definite.
Eigen::VectorXd bounded_minimum(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const Eigen::VectorXd& lower,
                                const Eigen::VectorXd& upper);

class BaselineReach {
 public:
  /// Sizes of an effect, with the products that every problem with them needs.
  struct Sizes {
    Eigen::MatrixXd E;             ///< [rows x sizes]
    Eigen::VectorXd lower, upper;  ///< [sizes]
    Eigen::MatrixXd JtE, EtE;
  };
  struct Taken {
    Eigen::VectorXd left;    ///< x - J u - E a
    Eigen::VectorXd amount;  ///< a
    double cost = 0;         ///< |left|² + |u|²
  };

  /// columns: sensitivities(), one for each parameter; scale: of each channel.
  BaselineReach(const Evidence& evidence, const std::vector<std::vector<double>>& columns,
                const std::vector<double>& scale);

  /// Fitting rows as x, and back.
  Eigen::VectorXd weighted(const std::vector<double>& rows) const;
  std::vector<double> rows(const Eigen::VectorXd& weighted) const;

  /// ½ ln det(1 + Jᵀ J): how much narrower than their tolerances the data make the numbers, nats.
  double half_log_det() const;

  /// E [rows x sizes] is weighted; the bounds are those of a, [sizes].
  Sizes sizes(Eigen::MatrixXd E, Eigen::VectorXd lower, Eigen::VectorXd upper) const;
  /// The bounded minimum for x, without an effect and with one.
  Taken take(const Eigen::VectorXd& x) const;
  Taken take(const Eigen::VectorXd& x, const Sizes& sizes) const;

 private:
  Eigen::VectorXd weight_;  ///< [rows]
  Eigen::MatrixXd J_, A_;   ///< A = Jᵀ J + 1
};

}  // namespace halyard
