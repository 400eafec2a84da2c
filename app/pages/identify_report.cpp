#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/pages/diagnosis/view_charts.h"
#include "app/pages/estimator_table.h"
#include "app/pages/identify_output.h"

namespace halyard {
namespace {

/// The estimate of one number over time from sample `first` on, with the band of two deviations; the band is cut where
/// it would leave no room for the rest.
report::Chart convergence_chart(const Identification& found, const IdentifiedNumber& number, std::size_t first,
                                const std::string& title) {
  report::Series estimate, end, given;
  estimate.name = "dual filter, ± 2 standard deviations";
  end.name = "identified", given.name = "model";
  end.dashed = given.dashed = true;
  report::Band band;
  for (std::size_t i = first; i < found.time.size(); ++i) {
    estimate.x.push_back(found.time[i]);
    estimate.y.push_back(number.trace[i]);
    band.lower.push_back(number.trace[i] - 2 * number.trace_std[i]);
    band.upper.push_back(number.trace[i] + 2 * number.trace_std[i]);
  }
  const bool whole = first == 0;
  auto [low, high] = std::ranges::minmax(estimate.y);
  low = std::min({low, number.value, whole ? number.nominal : low});
  high = std::max({high, number.value, whole ? number.nominal : high});
  const double last_band = number.trace_std.back(), room = std::max(0.5 * (high - low), 3 * last_band);
  for (double& b : band.lower) b = std::max(b, low - room);
  for (double& b : band.upper) b = std::min(b, high + room);
  estimate.band = std::move(band);
  for (report::Series* s : {&end, &given}) {
    s->x = {estimate.x.front(), estimate.x.back()};
    s->y.assign(2, s == &end ? number.value : number.nominal);
  }
  report::Chart chart;
  chart.title = title;
  chart.x_label = "time [s]";
  chart.y_label = number.unit == "1" ? "value" : fmt::format("value [{}]", number.unit);
  chart.series = {estimate, end};
  if (whole) chart.series.push_back(given);
  chart.height_px = 260;
  return chart;
}

void add_sentences(report::Page& page, const IdentificationStudy& result) {
  const Identification& found = result.identification;
  const auto all_converged = std::ranges::all_of(
      found.numbers, [](const IdentifiedNumber& n) { return n.convergence == Convergence::converged; });
  std::vector<std::string> became, doubted;
  for (const IdentifiedNumber& n : found.numbers)
    became.push_back(fmt::format("{}: {}.", capitalised(n.name), in_words(n.convergence)));
  page.verdict(all_converged ? report::VerdictKind::good : report::VerdictKind::warning,
               "What became of each number:", became);
  for (const std::string& doubt : doubts(result)) doubted.push_back(capitalised(doubt) + ".");
  if (!doubted.empty())
    page.verdict(adopted(result) ? report::VerdictKind::warning : report::VerdictKind::bad,
                 "Doubts about the result:", doubted);
}

void add_numbers(report::Page& page, const Identification& found) {
  report::Table table;
  table.caption = "Identified numbers";
  table.header = {"number", "model", "identified", "95 % interval", "half width", "unit", ""};
  table.align = {report::Align::left,  report::Align::right, report::Align::right, report::Align::right,
                 report::Align::right, report::Align::left,  report::Align::left};
  for (const IdentifiedNumber& n : found.numbers) {
    const double half_width = 50 * (n.upper - n.lower) / std::abs(n.value);  // %
    table.rows.push_back({n.name, fmt::format("{:.5g}", n.nominal), fmt::format("{:.7g}", n.value),
                          fmt::format("{:.7g} to {:.7g}", n.lower, n.upper),
                          half_width < 100 ? fmt::format("{:.2g} %", half_width) : fmt::format("{:.0f} %", half_width),
                          n.unit,
                          n.convergence == Convergence::converged  ? ""
                          : n.convergence == Convergence::drifting ? "drifting"
                                                                   : "not excited"});
  }
  page.table(table);
}

void add_errors(report::Page& page, const IdentificationStudy& result) {
  add_estimator_table(page, result.given, result.estimators, "identified",
                      "Joint position from motor signals alone, on " + result.holdout);
  page.paragraph(
      "kinematics takes cables as rigid: with the right coupling, the stretch of the cables is left as its error.");
}

}  // namespace

std::string in_words(Convergence convergence) {
  switch (convergence) {
    case Convergence::converged: return "converged";
    case Convergence::drifting:
      return "still drifting in the last third of the data; the model may lack something, or the log is too short";
    case Convergence::not_excited: break;
  }
  return "not excited: these data say little about it; use a log whose motion depends on it";
}

report::Page identify_page(const IdentificationStudy& result) {
  const Identification& found = result.identification;
  report::Page page("Identification of " + result.given.name,
                    fmt::format("{} of its numbers, from {}", found.numbers.size(), result.data));
  add_sentences(page, result);
  add_numbers(page, found);
  page.paragraph(fmt::format(
      "Intervals come from {} blocks of the data, each left out once: an error that lasts for a while counts once, not "
      "at each sample. They include what the other numbers of the model may be off by within their tolerances.",
      found.blocks));
  add_errors(page, result);
  page.heading("Convergence");
  page.paragraph(
      "The dual filter's estimate while it goes through the data, from the model's number on: on the left all of it, "
      "on the right its last third. Its band is widened to what the interval says, and cut where the chart ends. The "
      "identified number is then fitted to the data as a whole, from the filter's end on, and the model's other "
      "numbers with it, within their tolerances.");
  const std::size_t late = found.time.size() * 2 / 3;
  for (const IdentifiedNumber& number : found.numbers)
    page.figure_row({convergence_chart(found, number, 0, capitalised(number.name)),
                     convergence_chart(found, number, late, capitalised(number.name) + ", last third")});
  return page;
}

}  // namespace halyard
