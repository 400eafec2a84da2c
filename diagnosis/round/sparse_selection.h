#pragma once
/// Which few groups of columns explain a signal together? Groups that explain little alone may explain much beside each
/// other, so sets of groups are compared, and not groups:
///
///   minimise over sets S and amounts a, lower <= a <= upper:
///     Σ_c n_c / (2 m) ln(|x_c - E_c a|² / n_c + least_c²) + ½ Σ_i P_i a_i² + Σ_{g in S} (½ k_g ln(N / m) + ln G)
///
///   x_c, E_c   rows of channel c of the signal and of the columns: those that every set may use, and those of S
///   n_c, N     rows of channel c, of all channels       m     rows that equal one independent sample
///   P          information of the prior                 k_g   numbers that group g adds       G   owners of groups
///
/// The last sum is an extended BIC: a set has to pay for its numbers, and for having been chosen among many.
/// Method: forward selection of groups that keeps the best few sets of each size. Sources: Pati, Rezaiifar,
/// Krishnaprasad, Asilomar 27 (1993), orthogonal matching pursuit; Chen, Chen, Biometrika 95 (2008), extended BIC.

#include <Eigen/Core>
#include <vector>

namespace halyard {

/// Columns that enter a set together.
struct ColumnGroup {
  Eigen::Index first = 0, size = 0;  ///< its columns
  int numbers = 0;                   ///< k_g
  int owner = 0;                     ///< a set has at most one group of each owner
};

struct SparseProblem {
  Eigen::VectorXd x;                    ///< [rows]
  Eigen::MatrixXd columns;              ///< [rows x columns]; those that every set may use come first
  Eigen::Index free = 0;                ///< number of columns that every set may use
  Eigen::VectorXd lower, upper;         ///< of the amounts, [columns]
  Eigen::VectorXd prior;                ///< P, [columns]
  std::vector<int> channel;             ///< of each row
  std::vector<double> least_square;     ///< least_c², [channels]
  std::vector<double> correlated_rows;  ///< m_c, [channels]
  std::vector<ColumnGroup> groups;
};

struct SelectedGroups {
  std::vector<std::size_t> groups;  ///< ascending
  Eigen::VectorXd amount;           ///< a, [columns]; 0 where the set has no column
  double cost = 0;
};

/// The best set of at most so many groups. beam: sets of each size that are grown further.
SelectedGroups select_groups(const SparseProblem& problem, std::size_t most, std::size_t beam);

}  // namespace halyard
