#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/pages/comparison_figures.h"
#include "app/pages/diagnosis/diagnosis_output.h"
#include "app/tour/experiments_report.h"
#include "app/tour/tour.h"
#include "diagnosis/explanation/view_sentence.h"

namespace halyard {
namespace {

using report::Align;
using report::Cell;
using report::Chart;
using report::Page;
using report::Series;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Mean absolute errors of a joint in each experiment, and on the robot.
Chart joint_chart(const std::vector<Experiment>& experiments, int k) {
  const Comparison& first = experiments.front().comparison;
  Chart chart{.title = fmt::format("Joint {}: mean absolute error", k + 1),
              .y_label = fmt::format("error [{}]", first.units[k].shown),
              .kind = report::ChartKind::bar,
              .categories = {"A", "B", "C", "robot"}};
  for (std::size_t i = 0; i < first.runs.size(); ++i) {
    Series series{.name = first.runs[i].name};
    for (const Experiment& e : experiments) {
      series.y.push_back(first.units[k].shown_per_si * e.comparison.errors[i][k].mean_absolute);
    }
    const auto& robot = published_errors();
    series.y.push_back(series.name == "kinematics" ? robot[0].error[k]
                       : series.name == "sr_ukf"   ? robot[1].error[k]
                                                   : kNan);
    chart.series.push_back(std::move(series));
  }
  return chart;
}

void add_experiments(Page& page, const std::vector<Experiment>& experiments) {
  page.heading("1. The paper's experiments, simulated");
  page.paragraph(
      "The RAVEN-II's first three joints follow sines: A with high tension, B with low tension, C with a payload of "
      "100 g. The robot has what the paper's is likely to have had beyond its model: other capstans, zeros that "
      "homing left off, friction on pulleys, hysteresis, runs that go slack. The estimators believe the paper's "
      "Table I and get motor torques and quantised motor positions, nothing of the joints. Calibrated: with a "
      "model whose couplings were identified with joint sensors in another motion.");
  page.table(mean_error_table(experiments));
  page.table(experiment_table(experiments));
  page.paragraph(
      "Robot: Table III for joint 2 in experiments A, B, C (its other entries are not known here) and Table IV for the "
      "means. In the figures the robot's bars are Table IV's.");
  std::vector<Chart> charts;
  for (int k = 0; k < 3; ++k) charts.push_back(joint_chart(experiments, k));
  page.figure_row(charts);
  page.paragraph(fmt::format("Kinematics errs {} as much as on the robot (joints 1, 2, 3). {} {}",
                             share_of_published(experiments), order_of_gains(experiments),
                             peaks_of_joint_one(experiments)));
  page.paragraph(
      "A filter infers the stretch of cables from forces; a wrong ratio or zero between motor and joint it cannot see, "
      "since the motors read the same. Which effects a robot has, logs with joint sensors have to tell: that is what "
      "the rest of this page is about.");
  page.link("All trajectories, errors and tables of the experiments", "experiments/report.html");
}

report::Table found_table(const Tour& tour) {
  report::Table table;
  table.caption = "What the log's robot had, and what the diagnosis found without knowing";
  table.header = {"effect", "parameter", "unit", "true", "found", "95 % interval"};
  table.align = {Align::left, Align::left, Align::left, Align::right, Align::right, Align::right};
  for (const FoundParameter& p : found_parameters(tour)) {
    table.rows.push_back(
        {p.effect, p.name, p.unit, fmt::format("{:.4g}", p.value),
         p.found ? fmt::format("{:.4g}", p.found->value) : std::string("not found"),
         p.found ? fmt::format("{:.4g} to {:.4g}", p.found->lower, p.found->upper) : std::string("-")});
  }
  return table;
}

void add_bundled(Page& page, const Tour& tour) {
  page.heading("2. A log with an effect that the model does not know");
  page.paragraph(
      "examples/raven2/undeclared_effect.csv is a log of a simulated RAVEN-II that differs from raven2.xml. The "
      "diagnosis gets the model and the log, not the scenario that the log was made from.");
  add_verdict(page, tour.bundled.diagnosis, tour.bundled.evaluation);
  page.table(found_table(tour));
  add_error_table(page, tour.bundled.diagnosis);
  add_estimator_errors(page, tour.bundled.model, tour.bundled.evaluation);
  for (const PlacedEffect& effect : tour.undeclared) {
    page.figure_row(residual_charts(tour.bundled.diagnosis, effect.joint.value_or(0)));
  }
  page.link("The whole diagnosis, candidate by candidate", "undeclared_effect/report.html");
  page.link("The revised model, ready for every other command", "undeclared_effect/model.xml");
}

std::string number_of(double value, const ShownUnit& unit) {
  return std::isfinite(value) ? shown(value, unit) : std::string("no sensor");
}

void add_rig_rows(report::Table& table, const RigResult& result) {
  const Diagnosis& d = result.diagnosed->diagnosis;
  const std::vector<JointUnit> units = joint_units(result.diagnosed->model);
  const auto less = [](double before, double after) { return after < 0.9 * before; };
  for (int k = 0; k < result.diagnosed->model.n(); ++k) {
    const ShownUnit position{units[k].shown, units[k].shown_per_si};
    const ShownUnit torque = residual_unit(result.diagnosed->model.nominal, k, ResidualKind::motor_torque);
    table.rows.push_back(
        {k == 0 ? Cell::link(result.rig.title, result.rig.name + "/report.html") : Cell(""),
         Cell(k == 0 ? verdict_line(d) : ""), Cell(std::to_string(k + 1)), number_of(d.before.joint_rms[k], position),
         Cell(number_of(d.after.joint_rms[k], position), less(d.before.joint_rms[k], d.after.joint_rms[k])),
         number_of(d.before.torque_rms[k], torque),
         Cell(number_of(d.after.torque_rms[k], torque), less(d.before.torque_rms[k], d.after.torque_rms[k]))});
  }
}

void add_rigs(Page& page, const Tour& tour) {
  page.heading("3. Recordings of real rigs");
  report::Table table;
  table.caption = "Errors on the hold-out, which no fit has seen, with the given and the revised model (RMS)";
  table.header = {"rig", "verdict", "joint", "position before", "after", "torque or force before", "after"};
  table.align = {Align::left, Align::left, Align::right, Align::right, Align::right, Align::right, Align::right};
  std::string missing;
  for (const RigResult& result : tour.rigs) {
    if (result.diagnosed) {
      add_rig_rows(table, result);
    } else {
      missing += fmt::format("\n{}: examples/measured/{}/README.md", result.rig.title, result.rig.folder);
    }
  }
  if (!table.rows.empty()) {
    page.paragraph(
        "Their models are data sheets and published numbers at best. Position is predicted from motor signals alone, "
        "torque from the motion. To save time, this page asks of each recording only which single effect explains "
        "most; "
        "halyard diagnose asks on, and the README of each rig has its command line.");
    page.table(table);
  }
  if (!missing.empty()) {
    page.verdict(
        report::VerdictKind::neutral,
        "Not at hand. Where to get the recordings, which halyard tour --recordings DIR then diagnoses:" + missing);
  }
}

}  // namespace

void write_tour(OutputFiles& files, const std::filesystem::path& folder, const Tour& tour) {
  Page page("Halyard on one page",
            "Joint positions of cable-driven arms from motor signals: the paper's experiments, a diagnosis, and "
            "recordings of real rigs");
  add_experiments(page, tour.experiments);
  add_bundled(page, tour);
  add_rigs(page, tour);

  write_experiments(files, folder / "experiments", tour.experiments);
  write_diagnosis(files, folder / "undeclared_effect", tour.bundled.model, tour.bundled.diagnosis,
                  tour.bundled.evaluation);
  for (const RigResult& result : tour.rigs) {
    if (!result.diagnosed) continue;
    const auto& [model, diagnosis, evaluation] = *result.diagnosed;
    write_diagnosis(files, folder / result.rig.name, model, diagnosis, evaluation);
  }
  files.add(folder / "report.html", page.html());
}

}  // namespace halyard
