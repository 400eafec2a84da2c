#pragma once
/// Residuals that were predicted lately. A fit, the score of what it finds and the fit after it ask for the same
/// hypotheses again: one in six.

#include <compare>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "diagnosis/motion/chebyshev.h"
#include "diagnosis/prediction/prediction.h"

namespace halyard {

class RecentResiduals {
 public:
  /// Everything that the residuals depend on, to the last bit: a replay is rounded in another way.
  struct Key {
    Key(const Hypothesis& h, const Record& record, int stride, const RungeKuttaChebyshev& scheme, bool is_replayed);
    std::partial_ordering operator<=>(const Key&) const = default;
    std::size_t bytes() const { return numbers_.size() * sizeof(double); }
    /// False if one of its numbers is NaN: then it has no place in an order.
    bool can_be_found() const;

   private:
    const Record* record_;
    int stride_, steps_, stages_;
    bool is_replayed_;
    std::vector<const Effect*> effects_;
    std::vector<double> numbers_;
  };

  explicit RecentResiduals(std::size_t most_bytes) : most_bytes_(most_bytes) {}
  /// The key can_be_found().
  std::optional<Residuals> find(const Key& key);
  /// Forgets the least recently used, as long as all together exceed `most_bytes`. The key can_be_found().
  void keep(Key key, Residuals residuals);

 private:
  struct Kept {
    Residuals residuals;
    std::list<const Key*>::iterator use;  ///< in by_use_
  };
  static std::size_t bytes_of(const Key& key, const Residuals& residuals);

  std::size_t most_bytes_, bytes_ = 0;
  std::mutex mutex_;
  std::map<Key, Kept> kept_;
  std::list<const Key*> by_use_;  ///< keys of kept_, the least recently used first
};

}  // namespace halyard
