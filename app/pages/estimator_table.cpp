#include "app/pages/estimator_table.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "evaluation/joint_unit.h"

namespace halyard {

void add_estimator_table(report::Page& page, const ArmModel& given, const std::vector<EstimatorComparison>& estimators,
                         const std::string& other, const std::string& caption) {
  const std::vector<JointUnit> units = joint_units(given);
  report::Table table;
  table.caption = caption;
  table.header = {"joint", "estimator", "RMS, given model", other + " model", "peak, given model", other + " model"};
  table.align = {report::Align::left,  report::Align::left,  report::Align::right,
                 report::Align::right, report::Align::right, report::Align::right};
  for (int k = 0; k < given.n(); ++k) {
    const auto value = [k](const std::vector<double>& v) {
      return v.empty() ? std::numeric_limits<double>::quiet_NaN() : v[k];
    };
    const auto cell = [&](const std::vector<double>& v) {
      if (v.empty()) return std::string("failed");
      if (!std::isfinite(v[k])) return std::string("no sensor");
      return fmt::format("{:.3g} {}", units[k].shown_per_si * v[k], units[k].shown);
    };
    for (const EstimatorComparison& e : estimators)
      table.rows.push_back({fmt::format("{}", k + 1), e.name, cell(e.before.rms),
                            report::Cell::of_change(cell(e.after.rms), value(e.before.rms), value(e.after.rms)),
                            cell(e.before.peak),
                            report::Cell::of_change(cell(e.after.peak), value(e.before.peak), value(e.after.peak))});
  }
  page.table(table);
  std::string failures;
  for (const EstimatorComparison& e : estimators)
    for (const auto& [model, failure] :
         {std::pair<std::string, std::string>{"given", e.before.failure}, {other, e.after.failure}})
      if (!failure.empty())
        failures +=
            fmt::format("{}{} failed with the {} model: {}", failures.empty() ? "" : "; ", e.name, model, failure);
  if (!failures.empty()) page.paragraph(failures + ".");
}

}  // namespace halyard
