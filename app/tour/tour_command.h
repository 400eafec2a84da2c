#pragma once

#include <filesystem>

namespace halyard {

struct TourOptions {
  std::filesystem::path out;         ///< folder
  std::filesystem::path examples;    ///< empty: the examples that belong to this program
  std::filesystem::path recordings;  ///< empty: shared/data beside the source tree, which need not exist
};

/// halyard tour: the paper's experiments, a diagnosis of a bundled log, and the recordings of real rigs if they are
/// available. One report has links to all others.
void run_tour(const TourOptions& options);

}  // namespace halyard
