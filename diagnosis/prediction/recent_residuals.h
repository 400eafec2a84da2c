#pragma once
/// Residuals that were predicted lately. A fit, the score of what it finds and the fit after it ask for the same
/// hypotheses again: one in six.

#include <compare>
#include <cstdint>
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
    Key(const Hypothesis& h, const Record& record, int stride, const Chebyshev& scheme, bool is_replayed);
    std::partial_ordering operator<=>(const Key&) const = default;

   private:
    const Record* record_;
    int stride_, steps_, stages_;
    bool is_replayed_;
    std::vector<const Effect*> effects_;
    std::vector<double> numbers_;
  };

  explicit RecentResiduals(std::size_t most) : most_(most) {}
  std::optional<Residuals> find(const Key& key);
  /// Forgets what was not asked for longest, if there are more than `most`.
  void keep(Key key, Residuals residuals);

 private:
  struct Kept {
    Residuals residuals;
    std::uint64_t last_use;
  };
  std::size_t most_;
  std::mutex mutex_;
  std::map<Key, Kept> kept_;
  std::uint64_t uses_ = 0;
};

}  // namespace halyard
