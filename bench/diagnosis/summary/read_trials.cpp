#include "bench/diagnosis/summary/read_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "model/input_error.h"

namespace halyard::blind {
namespace {

namespace fs = std::filesystem;

struct Read {
  Result result;
  std::string where;  ///< "DIR/trials/clean-good-off1-raven2-000001.json", or "FILE:2"
  /// Of the file that a run would write: the same for no other trial.
  std::string name() const { return result_path("", result.situation, result.index).filename().string(); }
};

void read_folder(const fs::path& folder, std::vector<Read>& all) {
  if (!fs::is_directory(folder / "trials"))
    throw InputError(folder.string() + ": holds no trials; give the folder of an earlier --out, or its trials.jsonl");
  for (const auto& entry : fs::directory_iterator(folder / "trials"))
    if (entry.path().extension() == ".json") all.push_back({read_result(entry.path()), entry.path().string()});
}

void read_lines(const fs::path& file, std::vector<Read>& all) {
  std::size_t line = 0;
  for (Result& r : read_result_lines(file)) all.push_back({std::move(r), fmt::format("{}:{}", file.string(), ++line)});
}

void check_that_one_draw(const Read& first, const Read& read) {
  const Result &r = read.result, &of_first = first.result;
  if (r.seed != of_first.seed)
    throw InputError(fmt::format("{}: seed {}, but {} has seed {}; summarise one draw at a time", read.where, r.seed,
                                 first.where, of_first.seed));
  if (r.outliers != of_first.outliers)
    throw InputError(fmt::format("{}: outliers {}, but {} has outliers {}; summarise one draw at a time", read.where,
                                 r.outliers, first.where, of_first.outliers));
  const auto rule = [](const Result& of) { return of.rule.empty() ? "no --rule" : "--rule " + of.rule; };
  if (r.rule != of_first.rule)
    throw InputError(fmt::format("{}: {}, but {} has {}; summarise one draw at a time", read.where, rule(r),
                                 first.where, rule(of_first)));
}

}  // namespace

std::vector<Result> read_trials(const std::vector<fs::path>& sources) {
  std::vector<Read> all;
  for (const fs::path& source : sources) {
    if (fs::is_regular_file(source)) read_lines(source, all);
    else read_folder(source, all);
  }
  std::ranges::sort(all, {}, [](const Read& r) { return std::pair(r.name(), r.where); });
  std::vector<Result> results;
  for (std::size_t i = 0; i < all.size(); ++i) {
    check_that_one_draw(all[0], all[i]);
    if (i > 0 && all[i].name() == all[i - 1].name())
      throw InputError(fmt::format("{}: is the same trial as {}; remove one of them, or leave out its folder",
                                   all[i].where, all[i - 1].where));
    results.push_back(all[i].result);
  }
  return results;
}

}  // namespace halyard::blind
