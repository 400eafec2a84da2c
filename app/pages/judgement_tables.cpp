#include "app/pages/judgement_tables.h"

#include <fmt/core.h>

#include <cmath>

#include "app/pages/comparison_figures.h"
#include "app/pages/comparison_output.h"
#include "evaluation/json.h"
#include "model/output/number_text.h"

namespace halyard {
namespace {

using nlohmann::ordered_json;
using report::Cell;

std::string mean_in_band(const Consistency& c) {
  return std::isnan(c.mean) ? "-" : fmt::format("{:.4g} ({:.4g} to {:.4g})", c.mean, c.lower, c.upper);
}

const char* word(Confidence confidence) {
  switch (confidence) {
    case Confidence::unstated: break;
    case Confidence::consistent: return "consistent";
    case Confidence::overconfident: return "too sure";
    case Confidence::underconfident: return "too cautious";
  }
  return "none";
}

const char* verdict(const PairedRatio& r) {
  return r.better() ? "better" : r.worse() ? "worse" : "no difference shown";
}

report::Table table_of(std::string caption, std::vector<std::string> header, std::size_t left) {
  report::Table table;
  table.caption = std::move(caption);
  table.header = std::move(header);
  table.align.assign(table.header.size(), report::Align::right);
  for (std::size_t i = 0; i < left; ++i) table.align[i] = report::Align::left;
  return table;
}

}  // namespace

std::string in_words(const PairedRatio& r) {
  if (std::isnan(r.ratio)) return "-";
  // As many digits as it takes to see on which side of 1 the interval lies.
  int digits = 4;
  const auto hides = [&](double bound) { return bound != 1 && rounded_to_digits(bound, digits) == 1; };
  while (digits < 10 && (hides(r.lower) || hides(r.upper))) ++digits;
  return fmt::format("{:.{}g} (95 %: {:.{}g} to {:.{}g}): {}", r.ratio, digits, r.lower, digits, r.upper, digits,
                     verdict(r));
}

report::Table consistency_table(const Comparison& comparison) {
  report::Table table = table_of("Does each know how far off it is? Means that ought to be 1, and their 95 % bands",
                                 {"estimator", "of", "mean square (band)", "verdict"}, 2);
  table.align.back() = report::Align::left;
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    const Judgement& j = comparison.judgements[i];
    if (!comparison.runs[i].failure.empty()) continue;
    const Cell name(comparison.runs[i].name);
    if (j.nis.confidence() != Confidence::unstated)
      table.rows.push_back({name, Cell("innovations (NIS)"), Cell(mean_in_band(j.nis)), Cell(in_words(j.nis))});
    for (int k = 0; k < comparison.n_joints(); ++k) {
      if (comparison.has_truth(k))
        table.rows.push_back({name, Cell(fmt::format("error of joint {} (NEES)", k + 1)), Cell(mean_in_band(j.nees[k])),
                              Cell(in_words(j.nees[k]))});
    }
    for (int k = 0; k < comparison.n_joints(); ++k)
      if (!std::isnan(j.whiteness[k].correlation))
        table.rows.push_back({name, Cell(fmt::format("innovation of motor {} in time", k + 1)), Cell("-"),
                              Cell(in_words(j.whiteness[k]))});
  }
  return table;
}

report::Table paired_table(const Comparison& comparison) {
  report::Table table =
      table_of("Which is better? RMS error of the first over that of the second, at the same instants",
               {"joint", "estimator", "against", "ratio of RMS errors"}, 4);
  for (int k = 0; k < comparison.n_joints(); ++k)
    for (std::size_t a = 0; a < comparison.runs.size() && comparison.has_truth(k); ++a)
      for (std::size_t b = 0; b < a; ++b)
        table.rows.push_back({Cell(std::to_string(k + 1)), Cell(comparison.runs[a].name), Cell(comparison.runs[b].name),
                              Cell(in_words(comparison.paired[a][b][k]))});
  return table;
}

report::Table runs_error_table(const MonteCarlo& runs, const std::vector<JointUnit>& units) {
  report::Table table = table_of(
      fmt::format(
          "{} runs with seeds of their own{}", runs.runs,
          runs.noise ? fmt::format(", disturbed by {:g} times the noise that filters assume", *runs.noise) : ""),
      {"joint", "estimator", "unit", "RMS", "95 % of the runs", "peak", "failures", "RMS over that of kinematics"}, 3);
  table.align.back() = report::Align::left;
  for (std::size_t k = 0; k < units.size(); ++k)
    for (const RunsOfEstimator& e : runs.estimators)
      table.rows.push_back(
          {Cell(std::to_string(k + 1)), Cell(e.name), Cell(units[k].shown),
           Cell(shown_number(e.errors[k].rms, units[k])),
           Cell(shown_number(e.rms_lower[k], units[k]) + " to " + shown_number(e.rms_upper[k], units[k])),
           Cell(shown_number(e.errors[k].peak, units[k])), Cell(std::to_string(e.failures)),
           Cell(in_words(e.against_kinematics[k]))});
  return table;
}

report::Table runs_consistency_table(const MonteCarlo& runs) {
  report::Table table = table_of(fmt::format("Does each know how far off it is, over {} runs?", runs.runs),
                                 {"joint", "estimator", "NEES (band)", "instants in band", "verdict"}, 2);
  table.align.back() = report::Align::left;
  for (std::size_t k = 0; k < runs.estimators.front().nees.size(); ++k)
    for (const RunsOfEstimator& e : runs.estimators)
      table.rows.push_back({Cell(std::to_string(k + 1)), Cell(e.name), Cell(mean_in_band(e.nees[k])),
                            Cell(shown_percent(e.in_band[k])), Cell(in_words(e.nees[k]))});
  return table;
}

ordered_json to_json(const Consistency& c) {
  return {{"mean", number_or_null(c.mean)},
          {"band95", {number_or_null(c.lower), number_or_null(c.upper)}},
          {"independent_samples", number_or_null(c.samples)},
          {"readings", number_or_null(c.readings)},
          {"verdict", word(c.confidence())}};
}

ordered_json to_json(const PairedRatio& r) {
  return {{"rms_ratio", number_or_null(r.ratio)},
          {"ci95", {number_or_null(r.lower), number_or_null(r.upper)}},
          {"block_samples", r.block},
          {"verdict", std::isnan(r.ratio) ? ordered_json(nullptr) : ordered_json(verdict(r))}};
}

ordered_json to_json(const MonteCarlo& runs) {
  ordered_json estimators = ordered_json::array();
  for (const RunsOfEstimator& e : runs.estimators) {
    ordered_json joints = ordered_json::array();
    for (std::size_t k = 0; k < e.errors.size(); ++k)
      joints.push_back({{"joint", k + 1},
                        {"rms_error", number_or_null(e.errors[k].rms)},
                        {"rms_of_runs95", {number_or_null(e.rms_lower[k]), number_or_null(e.rms_upper[k])}},
                        {"mean_absolute_error", number_or_null(e.errors[k].mean_absolute)},
                        {"peak_error", number_or_null(e.errors[k].peak)},
                        {"bias", number_or_null(e.errors[k].bias)},
                        {"nees", to_json(e.nees[k])},
                        {"instants_in_band", number_or_null(e.in_band[k])},
                        {"against_kinematics", to_json(e.against_kinematics[k])}});
    estimators.push_back({{"estimator", e.name},
                          {"failures", e.failures},
                          {"first_failure", text_or_null(e.first_failure)},
                          {"nis", to_json(e.nis)},
                          {"joints", joints}});
  }
  return {{"runs", runs.runs},
          {"noise", runs.noise ? ordered_json(*runs.noise) : ordered_json(nullptr)},
          {"estimators", estimators}};
}

}  // namespace halyard
