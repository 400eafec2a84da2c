#pragma once
/// The best ways to give each of n places one of n columns:
///
///   min over all permutations p of Σ_k cost(p_0 ... p_k)
///
/// Places are filled in their order. The cost of a place may depend on the columns of those before it. Branch and
/// bound: costs are not negative, so what costs more than the best complete permutations so far is not continued.

#include <functional>
#include <vector>

namespace halyard {

/// columns: those of the places 0..k. The cost of place k, at least 0; infinite if the column cannot be there.
using PlaceCost = std::function<double(const std::vector<int>& columns)>;

/// The `most` permutations p [n] with the least sums, the best first. Of equal sums, the first is the one in which the
/// first places have their own columns. Those of infinite sum are left out.
std::vector<std::vector<int>> best_assignments(int n, const PlaceCost& cost, std::size_t most);

/// The columns of the first places, completed with the others in their order.
std::vector<int> completed(std::vector<int> columns, int n);

}  // namespace halyard
