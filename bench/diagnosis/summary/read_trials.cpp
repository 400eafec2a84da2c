#include "bench/diagnosis/summary/read_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "model/input_error.h"

namespace halyard::blind {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> paths_in(const std::vector<fs::path>& folders) {
  std::vector<fs::path> paths;
  for (const fs::path& folder : folders) {
    if (!fs::is_directory(folder / "trials"))
      throw InputError(folder.string() + ": holds no trials; give the folder of an earlier --out");
    for (const auto& entry : fs::directory_iterator(folder / "trials"))
      if (entry.path().extension() == ".json") paths.push_back(entry.path());
  }
  std::ranges::sort(paths, {}, [](const fs::path& p) { return std::pair(p.filename(), p); });
  return paths;
}

void check_that_one_draw(const Result& first, const fs::path& path_of_first, const Result& r, const fs::path& path) {
  if (r.seed != first.seed)
    throw InputError(fmt::format("{}: seed {}, but {} has seed {}; summarise one draw at a time", path.string(), r.seed,
                                 path_of_first.string(), first.seed));
  if (r.outliers != first.outliers)
    throw InputError(fmt::format("{}: outliers {}, but {} has outliers {}; summarise one draw at a time", path.string(),
                                 r.outliers, path_of_first.string(), first.outliers));
  const auto rule = [](const Result& of) { return of.rule.empty() ? "no --rule" : "--rule " + of.rule; };
  if (r.rule != first.rule)
    throw InputError(fmt::format("{}: {}, but {} has {}; summarise one draw at a time", path.string(), rule(r),
                                 path_of_first.string(), rule(first)));
}

}  // namespace

std::vector<Result> read_trials(const std::vector<fs::path>& folders) {
  const std::vector<fs::path> paths = paths_in(folders);
  std::vector<Result> results;
  std::map<std::string, fs::path> met;
  for (const fs::path& path : paths) {
    const Result r = read_result(path);
    if (!results.empty()) check_that_one_draw(results[0], paths[0], r, path);
    const std::string key = result_path("", r.situation, r.index).string();
    if (const auto [there, is_new] = met.insert({key, path}); !is_new)
      throw InputError(fmt::format("{}: is the same trial as {}; remove one of them, or leave out its folder",
                                   path.string(), there->second.string()));
    results.push_back(r);
  }
  return results;
}

}  // namespace halyard::blind
