#pragma once
/// Whether the probabilities of a diagnosis come true as often as they say.
///
/// The claims of each kind are compared on their own: hundreds of answers that nothing is missing, nearly all of them
/// right, would hide names that are too sure of themselves. Claims are sorted into bins of a tenth. A bin with at least
/// kFewestInGroup claims is a group. Neighbouring bins with fewer are a group together; if these are still fewer,
/// together with the smaller of the groups beside them, which counts alone as well. So every claim is in a group.

#include <array>
#include <optional>
#include <string>

#include "bench/diagnosis/summary/selection.h"

namespace halyard::blind {

/// A probability that a diagnosis gave, and whether it came true.
struct Claim {
  double probability;
  bool came_true;
};

enum class ClaimKind {
  /// Of names: true if the effect is hidden, or true beside it. Of alternatives: true if it is hidden, and no name is
  /// right about it. An alternative that is true beside the hidden effects need not be what was named, and is left out.
  names,
  clean,  ///< true if nothing is hidden
  none,   ///< "none of these": true if an effect outside the library is hidden
};
inline constexpr std::array kClaimKinds = {ClaimKind::names, ClaimKind::clean, ClaimKind::none};
std::string words(ClaimKind kind);

/// All claims of this kind; `clean` and `none` not of effects that are too small to be seen, and of parameters beyond
/// their tolerance: there both answers may be right.
std::vector<Claim> claims_of(const Results& ran, ClaimKind kind);

/// Names with a probability above 0.9, and the others, that are right; without those that are merely true beside the
/// hidden effects.
struct RightNames {
  Proportion above_90, others;
};
RightNames right_names(const Results& ran);

/// Fewer claims say nothing.
inline constexpr int kFewestInGroup = 20;
struct ClaimGroup {
  double from = 0, to = 0;  ///< probabilities
  Proportion came_true;
  double sum = 0;  ///< of the probabilities
  double mean() const { return sum / came_true.of; }
  double distance() const { return std::abs(mean() - came_true.value()); }
};
/// In ascending order of `from`. A single group of fewer than kFewestInGroup claims if these are all; none of none.
std::vector<ClaimGroup> groups_of(const std::vector<Claim>& claims);
/// The group with the largest distance between mean probability and observed frequency; nothing of fewer than
/// kFewestInGroup claims.
std::optional<ClaimGroup> farthest_group(const std::vector<Claim>& claims);
/// Of each kind its groups: mean probability against observed frequency, with its binomial interval.
std::string probability_table(const Results& ran);

}  // namespace halyard::blind
