#pragma once
/// Lists of trials, and counts over them.

#include <algorithm>
#include <functional>
#include <vector>

#include "bench/diagnosis/results/proportion.h"
#include "bench/diagnosis/results/scoring.h"

namespace halyard::blind {

using Results = std::vector<const Result*>;
using Test = std::function<bool(const Result&)>;

inline Results those(const Results& all, const Test& wanted) {
  Results some;
  std::ranges::copy_if(all, std::back_inserter(some), [&](const Result* r) { return wanted(*r); });
  return some;
}

inline Proportion share(const Results& all, const Test& hit) {
  Proportion s;
  for (const Result* r : all) s.count(hit(*r));
  return s;
}

/// Seconds that a diagnosis took beside other trials, of those that ended.
inline std::vector<double> run_times(const Results& all) {
  std::vector<double> wall;
  for (const Result* r : all)
    if (r->failure.empty()) wall.push_back(r->wall_s);
  return wall;
}

}  // namespace halyard::blind
