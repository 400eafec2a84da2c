#include "bench/diagnosis/summary/probabilities.h"

#include <cmath>

namespace halyard::blind {
namespace {

bool is_in(const std::vector<Place>& places, const Place& place) {
  return std::ranges::find(places, place) != places.end();
}

void add_claims_of_names(const Result& r, std::vector<Claim>& claims) {
  const std::vector<NameScore> scores = score_names(r);
  const std::vector<Place> without_name = truth_without_name(r);
  for (std::size_t i = 0; i < r.named.size(); ++i) {
    claims.push_back({r.named[i].probability, scores[i] != NameScore::false_name});
    for (const Alternative& a : r.named[i].alternatives)
      if (const bool right = is_in(without_name, a.place); right || !is_in(r.also_true, a.place))
        claims.push_back({a.probability, right});
  }
}

bool is_sparse(const ClaimGroup& group) { return group.came_true.of < kFewestInGroup; }

/// Neighbours, in this order, as one.
ClaimGroup together(const ClaimGroup& a, const ClaimGroup& b) {
  return {a.from, b.to, {a.came_true.hits + b.came_true.hits, a.came_true.of + b.came_true.of}, a.sum + b.sum};
}

/// Bins of a tenth that are not empty.
std::vector<ClaimGroup> bins_of(const std::vector<Claim>& claims) {
  constexpr int kBins = 10;
  std::vector<ClaimGroup> bins(kBins);
  for (const Claim& c : claims) {
    ClaimGroup& bin = bins[static_cast<std::size_t>(std::clamp<double>(kBins * c.probability, 0, kBins - 1))];
    bin.came_true.count(c.came_true);
    bin.sum += c.probability;
  }
  for (int b = 0; b < kBins; ++b) {
    bins[static_cast<std::size_t>(b)].from = static_cast<double>(b) / kBins;
    bins[static_cast<std::size_t>(b)].to = static_cast<double>(b + 1) / kBins;
  }
  std::erase_if(bins, [](const ClaimGroup& bin) { return bin.came_true.of == 0; });
  return bins;
}

/// Group i with the smaller of the groups beside it.
ClaimGroup widened(const std::vector<ClaimGroup>& groups, std::size_t i) {
  const bool has_lower = i > 0, has_upper = i + 1 < groups.size();
  if (has_lower && (!has_upper || groups[i - 1].came_true.of <= groups[i + 1].came_true.of))
    return together(groups[i - 1], groups[i]);
  return has_upper ? together(groups[i], groups[i + 1]) : groups[i];
}

}  // namespace

std::string words(ClaimKind kind) {
  switch (kind) {
    case ClaimKind::names: return "names and their alternatives";
    case ClaimKind::clean: return "`clean`";
    case ClaimKind::none: break;
  }
  return "a cause outside the library";
}

std::vector<Claim> claims_of(const Results& ran, ClaimKind kind) {
  std::vector<Claim> claims;
  for (const Result* r : ran) {
    if (kind == ClaimKind::names) {
      add_claims_of_names(*r, claims);
      continue;
    }
    if (is_too_small(*r) || r->situation.off > 1) continue;
    const bool of_clean = kind == ClaimKind::clean;
    const std::optional<double> probability = of_clean ? r->probability_clean : r->probability_none;
    const bool came_true = of_clean ? r->truth.empty() : r->situation.kind == Kind::outside;
    if (probability) claims.push_back({*probability, came_true});
  }
  return claims;
}

RightNames right_names(const Results& ran) {
  RightNames right;
  for (const Result* r : ran) {
    const std::vector<NameScore> scores = score_names(*r);
    for (std::size_t i = 0; i < scores.size(); ++i) {
      const double probability = r->named[i].probability;
      if (scores[i] == NameScore::also_true) continue;
      (probability > 0.9 ? right.above_90 : right.others).count(scores[i] == NameScore::right);
    }
  }
  return right;
}

std::vector<ClaimGroup> groups_of(const std::vector<Claim>& claims) {
  std::vector<ClaimGroup> disjoint;
  bool last_was_sparse = false;
  for (const ClaimGroup& bin : bins_of(claims)) {
    if (last_was_sparse && is_sparse(bin)) disjoint.back() = together(disjoint.back(), bin);
    else disjoint.push_back(bin);
    last_was_sparse = is_sparse(bin);
  }
  std::vector<ClaimGroup> groups;
  for (std::size_t i = 0; i < disjoint.size(); ++i)
    groups.push_back(is_sparse(disjoint[i]) ? widened(disjoint, i) : disjoint[i]);
  std::ranges::stable_sort(groups, {}, &ClaimGroup::from);
  return groups;
}

std::optional<ClaimGroup> farthest_group(const std::vector<Claim>& claims) {
  std::vector<ClaimGroup> groups = groups_of(claims);
  std::erase_if(groups, is_sparse);
  if (groups.empty()) return {};
  return *std::ranges::max_element(groups, {}, &ClaimGroup::distance);
}

std::string probability_table(const Results& ran) {
  std::string lines;
  for (const ClaimKind kind : kClaimKinds)
    for (const ClaimGroup& g : groups_of(claims_of(ran, kind)))
      lines += fmt::format("| {} | {:.1f} to {:.1f} | {:.3f} | {} | {:.1f} points |\n", words(kind), g.from, g.to,
                           g.mean(), g.came_true.cells(), 100 * g.distance());
  if (lines.empty()) return "";
  return "| of | probability | mean | came true | share | 95 % interval | distance "
         "|\n|---|---|---:|---:|---:|---|---:|\n" +
         lines + "\n";
}

}  // namespace halyard::blind
