#pragma once
/// Output files of a comparison. They contain no wall times: the same inputs give the same bytes.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/comparison/compare.h"
#include "evaluation/comparison/monte_carlo.h"
#include "evaluation/csv.h"
#include "model/output/output_files.h"

namespace halyard {

/// SI units; null where a number is not known.
nlohmann::ordered_json to_json(const Comparison& comparison);

/// Columns of error statistics, after the columns that name the row: joint, unit, mean_absolute_error, ...
std::vector<std::string> error_columns();
/// Adds these cells for one run and joint.
void add_error_cells(CsvTable& table, const Comparison& comparison, std::size_t run, int k);

/// Adds report.html, comparison.json and comparison.csv into the folder. runs: the results of the same comparison
/// over many seeds.
void write_comparison(OutputFiles& files, const std::filesystem::path& folder, const Comparison& comparison,
                      const std::optional<MonteCarlo>& runs = std::nullopt);

}  // namespace halyard
