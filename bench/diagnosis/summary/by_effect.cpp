#include "bench/diagnosis/summary/by_effect.h"

#include <fmt/ranges.h>

#include <set>

#include "transmission/effect.h"

namespace halyard::blind {
namespace {

using Name = std::function<std::string(const Result&)>;

/// Effects in the library's order; then what else was hidden, by name.
std::vector<std::string> names_of(const Results& results, const Name& name) {
  std::set<std::string> met;
  for (const Result* r : results) met.insert(name(*r));
  std::vector<std::string> all;
  for (const Effect* e : effect_library())
    if (met.erase(e->name())) all.push_back(e->name());
  all.insert(all.end(), met.begin(), met.end());
  return all;
}

std::string acting_name(const Result& r) {
  const TrueEffect& t = r.truth[0];
  return t.form.empty() ? t.place.effect : t.form + " (" + t.place.effect + ")";
}

std::string first_name(const Result& r) {
  if (!r.failure.empty()) return "failed";
  if (r.named.empty()) return r.verdict;
  const Named& first = r.named[0];
  const bool joint_only =
      !r.truth.empty() && first.place.effect == r.truth[0].place.effect && !is_right(r, first.place);
  return joint_only ? "other joint" : first.place.effect;
}

}  // namespace

std::string effect_table(const Results& trials) {
  std::string text =
      "| truth | strictly | share | 95 % interval | loosely | too small |\n|---|---:|---:|---|---:|---:|\n";
  const auto line = [&](const std::string& name, const Results& all) {
    const Results seen = those(all, [](const Result& r) { return !is_too_small(r); });
    text += fmt::format("| {} | {} | {}/{} | {} |\n", name, share(seen, strictly_right).cells(),
                        share(seen, loosely_right).hits, seen.size(), all.size() - seen.size());
  };
  for (const std::string& name : names_of(trials, acting_name))
    line(name, those(trials, [&](const Result& r) { return acting_name(r) == name; }));
  line("**all**", trials);
  return text + "\n";
}

std::vector<std::vector<std::string>> confusion(const Results& trials) {
  const auto truth = [](const Result& r) { return r.truth.empty() ? std::string("clean") : r.truth[0].place.effect; };
  std::vector<std::vector<std::string>> table = {{"truth \\ named first"}};
  const std::vector<std::string> columns = names_of(trials, first_name);
  table[0].insert(table[0].end(), columns.begin(), columns.end());
  for (const std::string& row : names_of(trials, truth)) {
    table.push_back({row});
    for (const std::string& column : columns) {
      const int n = share(trials, [&](const Result& r) { return truth(r) == row && first_name(r) == column; }).hits;
      table.back().push_back(n == 0 ? "" : std::to_string(n));
    }
  }
  return table;
}

std::string markdown(const std::vector<std::vector<std::string>>& table) {
  std::string text, rule = "|---";
  for (std::size_t c = 1; c < table[0].size(); ++c) rule += "|---:";
  for (std::size_t i = 0; i < table.size(); ++i) {
    text += fmt::format("| {} |\n", fmt::join(table[i], " | "));
    if (i == 0) text += rule + "|\n";
  }
  return text + "\n";
}

}  // namespace halyard::blind
