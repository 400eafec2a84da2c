#include "bench/diagnosis/summary/summary.h"

#include <fmt/ranges.h>

#include <map>

#include "bench/diagnosis/summary/acceptance.h"
#include "bench/diagnosis/summary/by_effect.h"
#include "bench/diagnosis/summary/probabilities.h"
#include "bench/diagnosis/summary/trials_csv.h"
#include "model/output/output_files.h"

namespace halyard::blind {
namespace {

std::string section(const std::string& title, const std::string& text) {
  return text.empty() ? "" : "## " + title + "\n\n" + text;
}

/// Draws before those that the trials show, with their reasons.
std::string dropped_draws(const Results& all) {
  std::map<std::string, int> times;
  int dropped = 0, silent = 0;
  for (const Result* r : all) {
    if (!r->dropped) {
      ++silent;
      continue;
    }
    for (const std::string& reason : *r->dropped) ++times[reason], ++dropped;
  }
  std::vector<std::string> reasons;
  for (const auto& [reason, n] : times) reasons.push_back(fmt::format("{} times: {}", n, reason));
  std::string text =
      fmt::format("{} draws of {} trials could not be recorded", dropped, static_cast<int>(all.size()) - silent);
  if (!reasons.empty()) text += fmt::format(" ({})", fmt::join(reasons, "; "));
  if (silent > 0) text += fmt::format("; {} trials do not tell how many of theirs could not be", silent);
  return text + ".";
}

/// The programs that diagnosed the trials; nothing where the trials do not tell.
std::string programs(const Results& all) {
  std::map<std::string, int> trials;
  for (const Result* r : all)
    if (!r->program.empty()) ++trials[r->program];
  std::vector<std::string> each;
  for (const auto& [program, n] : trials) each.push_back(fmt::format("{} ({} trials)", program, n));
  return each.empty() ? "" : fmt::format(" Diagnosed by {}.", fmt::join(each, "; "));
}

std::string head(const Results& all, const Results& ran) {
  return fmt::format(
      "# Blind trials of the diagnosis\n\n{} trials; {} could not be drawn, in {} the diagnosis failed. An effect "
      "counts if `--plan` promises that a diagnosis detects it; smaller ones have lines of their own. Seconds are "
      "those of one processor. {}{}{}\n\n",
      all.size(), all.size() - ran.size(), share(ran, [](const Result& r) { return !r.failure.empty(); }).hits,
      dropped_draws(all), programs(all),
      all.empty() || all[0]->rule.empty() ? "" : " Thresholds varied: " + all[0]->rule + ".");
}

/// Clean arms and those with one visible effect.
Results with_at_most_one(const Results& ran) {
  return those(ran, [](const Result& r) { return r.truth.size() <= 1 && !is_too_small(r); });
}

std::string tables_by_effect(const Results& ran) {
  std::string text;
  for (const Kind kind : {Kind::effect, Kind::form, Kind::outside})
    for (const Sensors sensors : {Sensors::good, Sensors::poor, Sensors::motors})
      for (const int off : {0, 1, 2}) {
        const Results some = those(ran, [&](const Result& r) {
          return r.situation.kind == kind && r.situation.sensors == sensors && r.situation.off == off;
        });
        if (!some.empty())
          text +=
              section(fmt::format("By effect: {}, {} sensors, off by {} tolerances", word(kind), word(sensors), off),
                      effect_table(some));
      }
  return text;
}

}  // namespace

std::string write_summary(const std::filesystem::path& out, const std::vector<Result>& results) {
  Results all;
  for (const Result& r : results) all.push_back(&r);
  const Results ran =
      those(all, [](const Result& r) { return r.failure.empty() || r.failure.starts_with("diagnose"); });
  const std::string acceptance = acceptance_table(ran);
  const auto table = confusion(with_at_most_one(ran));
  std::string csv, result_lines;
  for (const Result& r : results) result_lines += result_line(r) + "\n";
  for (const auto& row : table) csv += fmt::format("{}\n", fmt::join(row, ","));
  write_file_whole(out / "confusion.csv", csv);
  write_file_whole(out / "trials.csv", trials_csv(all));
  write_file_whole(out / "trials.jsonl", result_lines);
  write_file_whole(out / "summary.md",
                   head(all, ran) + section("Acceptance", acceptance) +
                       section("Probabilities against observed frequencies", probability_table(ran)) +
                       tables_by_effect(ran) +
                       section("Confusion: clean arms, and single effects that can be seen", markdown(table)));
  return acceptance;
}

}  // namespace halyard::blind
