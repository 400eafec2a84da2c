#include "diagnosis/log_check/exchanges/assignment.h"

#include <algorithm>
#include <limits>

namespace halyard {
namespace {

class Assignment {
 public:
  Assignment(int n, const PlaceCost& cost, std::size_t most) : n_(n), cost_(cost), most_(most), used_(n, false) {}

  std::vector<std::vector<int>> best() {
    fill_next(0);
    std::vector<std::vector<int>> all;
    for (const Complete& complete : best_) all.push_back(complete.columns);
    return all;
  }

 private:
  struct Complete {
    std::vector<int> columns;
    double sum;
  };

  /// Sums from here on are of no use.
  double bound() const { return best_.size() < most_ ? std::numeric_limits<double>::infinity() : best_.back().sum; }

  void keep(double sum) {
    const auto place = std::ranges::upper_bound(best_, sum, {}, &Complete::sum);
    best_.insert(place, {columns_, sum});
    if (best_.size() > most_) best_.pop_back();
  }

  void fill_next(double so_far) {
    const auto place = static_cast<int>(columns_.size());
    if (place == n_) return keep(so_far);
    struct Choice {
      double sum;
      int column;
    };
    std::vector<Choice> choices;
    for (int i = 0; i < n_; ++i) {
      const int column = (place + i) % n_;  // its own first
      if (used_[column]) continue;
      columns_.push_back(column);
      choices.push_back({so_far + cost_(columns_), column});
      columns_.pop_back();
    }
    std::ranges::stable_sort(choices, {}, &Choice::sum);
    for (const Choice& choice : choices) {
      if (!(choice.sum < bound())) return;
      columns_.push_back(choice.column), used_[choice.column] = true;
      fill_next(choice.sum);
      columns_.pop_back(), used_[choice.column] = false;
    }
  }

  int n_;
  const PlaceCost& cost_;
  std::size_t most_;
  std::vector<bool> used_;
  std::vector<int> columns_;
  std::vector<Complete> best_;  ///< the best first
};

}  // namespace

std::vector<std::vector<int>> best_assignments(int n, const PlaceCost& cost, std::size_t most) {
  return Assignment(n, cost, most).best();
}

std::vector<int> completed(std::vector<int> columns, int n) {
  const std::vector<int> first = columns;
  for (int column = 0; column < n; ++column)
    if (std::ranges::find(first, column) == first.end()) columns.push_back(column);
  return columns;
}

}  // namespace halyard
