#include "diagnosis/round/sparse_selection.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnosis/fit/baseline_reach.h"

namespace halyard {
namespace {

using Groups = std::vector<std::size_t>;

class Selector {
 public:
  explicit Selector(const SparseProblem& problem) : p_(problem) {
    find_products();
    std::set<int> owners;
    for (const ColumnGroup& g : p_.groups) owners.insert(g.owner);
    double samples = 0;
    for (std::size_t c = 0; c < count_.size(); ++c) samples += count_[c] / correlated_rows_[c];
    for (const ColumnGroup& g : p_.groups)
      price_.push_back(0.5 * g.numbers * std::log(samples) + std::log(static_cast<double>(owners.size())));
  }

  /// The cheapest amounts for a set; weight: of each channel to begin with.
  SelectedGroups solve(const Groups& groups, Eigen::VectorXd weight) const;
  /// The weight of each channel where the residual is what these amounts leave.
  Eigen::VectorXd weights(const Eigen::VectorXd& amount) const {
    Eigen::VectorXd all(amount.size() + 1);
    all << -amount, 1;
    Eigen::VectorXd weight(std::ssize(products_));
    for (std::size_t c = 0; c < products_.size(); ++c)
      weight(static_cast<Eigen::Index>(c)) = 1 / (correlated_rows_[c] * variance(c, all.dot(products_[c] * all)));
    return weight;
  }
  /// All sets with one group more than one of these, each once.
  std::vector<Groups> grown(const std::vector<SelectedGroups>& sets) const;

 private:
  /// Products of the columns and x with each other, for each channel that has rows.
  void find_products() {
    const Eigen::Index n = p_.columns.cols();
    for (std::size_t c = 0; c < p_.least_square.size(); ++c) {
      std::vector<Eigen::Index> rows;
      for (std::size_t r = 0; r < p_.channel.size(); ++r)
        if (p_.channel[r] == static_cast<int>(c)) rows.push_back(static_cast<Eigen::Index>(r));
      if (rows.empty()) continue;
      Eigen::MatrixXd all(std::ssize(rows), n + 1);
      all << p_.columns(rows, Eigen::all), p_.x(rows);
      count_.push_back(static_cast<double>(rows.size()));
      correlated_rows_.push_back(p_.correlated_rows[c]);
      least_square_.push_back(p_.least_square[c]);
      products_.push_back(Eigen::MatrixXd::Zero(n + 1, n + 1));
      products_.back().selfadjointView<Eigen::Lower>().rankUpdate(all.transpose());
      products_.back().triangularView<Eigen::StrictlyUpper>() = products_.back().transpose();
    }
  }
  double variance(std::size_t c, double sum_of_squares) const {
    return std::max(sum_of_squares, 0.0) / count_[c] + least_square_[c];
  }

  const SparseProblem& p_;
  std::vector<Eigen::MatrixXd> products_;  ///< [channels]
  std::vector<double> count_;              ///< n_c
  std::vector<double> correlated_rows_;    ///< m_c
  std::vector<double> least_square_;       ///< least_c²
  std::vector<double> price_;              ///< of each group
};

SelectedGroups Selector::solve(const Groups& groups, Eigen::VectorXd weight) const {
  // The logarithms are concave: the minimum for fixed weights, taken again with new weights, never rises.
  constexpr int kPasses = 3;
  constexpr double kAlike = 1e-9;  // columns may act alike; what they cannot share stays defined
  std::vector<Eigen::Index> place;
  for (Eigen::Index i = 0; i < p_.free; ++i) place.push_back(i);
  for (const std::size_t g : groups)
    for (Eigen::Index i = 0; i < p_.groups[g].size; ++i) place.push_back(p_.groups[g].first + i);
  const Eigen::Index n = std::ssize(place);
  const Eigen::VectorXd lower = p_.lower(place), upper = p_.upper(place), prior = p_.prior(place);
  place.push_back(p_.columns.cols());
  std::vector<Eigen::MatrixXd> products;
  for (const Eigen::MatrixXd& all : products_) products.push_back(all(place, place));

  SelectedGroups s{groups, Eigen::VectorXd::Zero(p_.columns.cols()), 0};
  Eigen::VectorXd a(n + 1);
  for (int pass = 0; pass < kPasses; ++pass) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + 1, n + 1);
    for (std::size_t c = 0; c < products.size(); ++c) A += weight(static_cast<Eigen::Index>(c)) * products[c];
    const Eigen::VectorXd b = A.col(n).head(n);
    A.diagonal().head(n) = (A.diagonal().head(n) + prior) * (1 + kAlike);
    if (n > 0) a.head(n) = -bounded_minimum(A.topLeftCorner(n, n), b, lower, upper);
    a(n) = 1;
    s.cost = 0.5 * a.head(n).cwiseAbs2().dot(prior);
    for (std::size_t c = 0; c < products.size(); ++c) {
      const double left = variance(c, a.dot(products[c] * a));
      s.cost += 0.5 * count_[c] / correlated_rows_[c] * std::log(left);
      weight(static_cast<Eigen::Index>(c)) = 1 / (correlated_rows_[c] * left);
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) s.amount(place[i]) = -a(i);
  for (const std::size_t g : groups) s.cost += price_[g];
  return s;
}

std::vector<Groups> Selector::grown(const std::vector<SelectedGroups>& sets) const {
  std::set<Groups> all;
  for (const SelectedGroups& set : sets)
    for (std::size_t g = 0; g < p_.groups.size(); ++g) {
      const auto same = [&](std::size_t other) { return p_.groups[other].owner == p_.groups[g].owner; };
      if (std::ranges::any_of(set.groups, same)) continue;
      Groups longer = set.groups;
      longer.insert(std::ranges::upper_bound(longer, g), g);
      all.insert(std::move(longer));
    }
  return {all.begin(), all.end()};
}

}  // namespace

SelectedGroups select_groups(const SparseProblem& problem, std::size_t most, std::size_t beam) {
  const Selector selector(problem);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(problem.columns.cols());
  SelectedGroups best = selector.solve({}, selector.weights(none));
  std::vector<SelectedGroups> sets = {best};
  for (std::size_t size = 1; size <= most && !sets.empty(); ++size) {
    const std::vector<Groups> grown = selector.grown(sets);
    const Eigen::VectorXd weight = selector.weights(sets.front().amount);
    sets.assign(grown.size(), {});
    tbb::parallel_for(std::size_t{0}, grown.size(), [&](std::size_t i) { sets[i] = selector.solve(grown[i], weight); });
    std::ranges::stable_sort(sets, {}, &SelectedGroups::cost);
    if (sets.size() > beam) sets.resize(beam);
    if (!sets.empty() && sets.front().cost < best.cost) best = sets.front();
  }
  return best;
}

}  // namespace halyard
