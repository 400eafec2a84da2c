#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/comparison_figures.h"
#include "app/comparison_output.h"
#include "app/experiments.h"
#include "app/report/page.h"
#include "model/output_file.h"

namespace halyard {
namespace {

using nlohmann::ordered_json;
using report::Cell;

const Comparison& first(const std::vector<Experiment>& experiments) { return experiments.front().comparison; }

/// Experiments A and B of the nominal model differ in nothing but a tension that its cable law does not carry.
bool equal_errors(const Comparison& a, const Comparison& b) {
  for (std::size_t i = 0; i < a.errors.size(); ++i) {
    for (int k = 0; k < a.n_joints(); ++k) {
      if (a.errors[i][k].mean_absolute != b.errors[i][k].mean_absolute) return false;
    }
  }
  return true;
}

void add_meaning(report::Page& page, const std::vector<Experiment>& experiments) {
  page.heading("What the numbers mean");
  page.paragraph(
      "These are simulations. The plant has the stretch and friction of the paper's Table I and nothing else; the "
      "estimators believe the same model, and in C they are not told of the payload. What is left of the filters' "
      "errors is the resolution of the motor encoders, the friction near standstill, and in C the payload.");
  page.paragraph(fmt::format(
      "Kinematics takes the cables as rigid. Its error here is {} of what it was on the robot (joints 1, 2, 3). The "
      "printed stiffness lets gravity stretch the cables by at most 0.04 deg, 0.23 deg and 0.22 mm, so that stretch "
      "alone cannot be what the paper measured: the robot has effects that the model lacks, such as another effective "
      "capstan radius, zero errors from homing, pulley friction, hysteresis or slack.",
      share_of_published(experiments)));
  page.paragraph(
      "So the gain of the filters over kinematics is an upper bound, for a model that is right, and no repetition of "
      "Table IV. There the same kind of filter gained 1.4 %, 36.8 % and 63.0 % on a robot whose effects it did not "
      "know. To see which effects a robot has, run halyard diagnose on its logs; to see what a missing effect costs, "
      "put it into a scenario and run halyard compare, or vary it with halyard sweep.");
  if (equal_errors(experiments[0].comparison, experiments[1].comparison)) {
    page.paragraph(
        "A and B give the same numbers: they differ in the cables' tension, and the paper's cable law (Eq. 6) does not "
        "carry tension. The exponential and the linear law do.");
  }
}

report::Page experiments_page(const std::vector<Experiment>& experiments) {
  report::Page page("The paper's experiments, simulated",
                    "RAVEN-II, joints 1 to 3: Haghighipanah, Li, Miyasaka, Hannaford, IROS 2015");
  page.paragraph(
      fmt::format("Sines on all joints, {:g} s each. Every estimator gets motor torques and quantised motor positions "
                  "and nothing of the joints. Errors are estimate minus the truth of the simulation, from {:g} s on.",
                  first(experiments).truth.duration(), first(experiments).skip_s));
  page.table(mean_error_table(experiments));
  add_meaning(page, experiments);
  for (const Experiment& experiment : experiments) {
    page.heading("Experiment " + experiment.name);
    page.table(error_table(experiment.comparison));
    add_joint_figures(page, experiment.comparison, experiment.name + ". ");
  }
  return page;
}

ordered_json experiments_json(const std::vector<Experiment>& experiments) {
  const Comparison& comparison = first(experiments);
  ordered_json means = ordered_json::array(), published = ordered_json::array(), details = ordered_json::array();
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    ordered_json errors = ordered_json::array();
    for (int k = 0; k < comparison.n_joints(); ++k) errors.push_back(number_or_null(mean_error(experiments, i, k)));
    means.push_back({{"estimator", comparison.runs[i].name}, {"mean_absolute_error", errors}});
  }
  for (const PublishedErrors& row : published_errors()) {
    ordered_json errors = ordered_json::array();
    for (int k = 0; k < comparison.n_joints(); ++k) {
      errors.push_back(row.error[k] / comparison.units[k].shown_per_si);
    }
    published.push_back({{"source", row.source}, {"mean_absolute_error", errors}});
  }
  for (const Experiment& experiment : experiments) {
    ordered_json detail = {{"experiment", experiment.name}};
    detail.update(to_json(experiment.comparison));
    details.push_back(detail);
  }
  return {{"mean_of_experiments", means}, {"measured_on_the_robot", published}, {"experiments", details}};
}

CsvTable experiments_table(const std::vector<Experiment>& experiments) {
  std::vector<std::string> header = error_columns();
  header.insert(header.begin(), {"experiment", "estimator"});
  CsvTable table(header);
  for (const Experiment& experiment : experiments) {
    const Comparison& comparison = experiment.comparison;
    for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
      for (int k = 0; k < comparison.n_joints(); ++k) {
        table.add(experiment.name);
        table.add(comparison.runs[i].name);
        add_error_cells(table, comparison, i, k);
      }
    }
  }
  return table;
}

}  // namespace

report::Table mean_error_table(const std::vector<Experiment>& experiments) {
  const Comparison& comparison = first(experiments);
  report::Table table;
  table.caption = "Mean absolute error (the paper's Eq. 18), mean of experiments A, B and C; robot: measured";
  table.header = {"where", "estimator"};
  table.align = {report::Align::left, report::Align::left};
  for (int k = 0; k < comparison.n_joints(); ++k) {
    table.header.push_back(fmt::format("joint {} [{}]", k + 1, comparison.units[k].shown));
    table.align.push_back(report::Align::right);
  }
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    std::vector<Cell> row = {"simulated", comparison.runs[i].name};
    for (int k = 0; k < comparison.n_joints(); ++k) {
      row.emplace_back(shown_number(mean_error(experiments, i, k), comparison.units[k]));
    }
    table.rows.push_back(std::move(row));
  }
  for (const PublishedErrors& published : published_errors()) {
    std::vector<Cell> row = {"robot", published.source};
    for (const double error : published.error) row.emplace_back(fmt::format("{:.4g}", error));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string share_of_published(const std::vector<Experiment>& experiments) {
  const Comparison& comparison = first(experiments);
  std::string text;
  for (int k = 0; k < comparison.n_joints(); ++k) {
    const double here = comparison.units[k].shown_per_si * mean_error(experiments, comparison.baseline(), k);
    text += fmt::format("{}1/{:.0f}", text.empty() ? "" : ", ", published_errors()[0].error[k] / here);
  }
  return text;
}

void write_experiments(const std::filesystem::path& folder, const std::vector<Experiment>& experiments) {
  const CsvTable table = experiments_table(experiments);
  const std::string json = json_text(experiments_json(experiments));
  const report::Page page = experiments_page(experiments);
  table.write(folder / "experiments.csv");
  write_file_whole(folder / "experiments.json", json);
  page.write(folder / "report.html");
}

}  // namespace halyard
