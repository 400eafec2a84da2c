#include "app/pages/diagnosis/diagnosis_output.h"

#include <fmt/format.h>

#include <cmath>

#include "app/pages/estimator_table.h"
#include "diagnosis/explanation/headline.h"
#include "diagnosis/explanation/view_sentence.h"
#include "evaluation/joint_unit.h"
#include "model/model_file.h"

namespace halyard {

std::vector<std::string> absent_event_lines(const Diagnosis& d) {
  std::vector<std::string> lines;
  for (const std::size_t e : d.absent_events)
    lines.push_back(
        fmt::format("The hold-out shows no {} at that time: its errors are predicted without it. model.xml "
                    "contains it: remove it there before you use the model for other logs.",
                    effect_label(d.revised.effects[e])));
  return lines;
}

std::string verdict_line(const Diagnosis& d) {
  std::string line = verdict_word(d.verdict);
  for (std::size_t i = 0; i < d.effects.size(); ++i)
    line += fmt::format("{}{} ({})", i == 0 ? ": " : ", ", label_of(d.effects[i]), percent(d.effects[i].probability));
  if (d.verdict == Diagnosis::Verdict::unknown) return line + ": " + unknown_headline(d.unexplained);
  if (d.verdict == Diagnosis::Verdict::clean) return line;
  const std::string remainder = remainder_headline(d.unexplained);
  return remainder.empty() ? line : line + "; " + remainder;
}

std::string tolerance_line(const Diagnosis& d) {
  if (d.tolerance_factor == 1) return "";
  return fmt::format(
      "The model is off by more than its tolerances state: its numbers were refitted within {:g} times these, which is "
      "more probable than an effect for each of them.",
      d.tolerance_factor);
}

/// Names of at least this probability are stated as facts.
constexpr double kSure = 0.9;

void add_verdict(report::Page& page, const Diagnosis& d, const DiagnosisEvaluation& evaluation) {
  switch (d.verdict) {
    case Diagnosis::Verdict::clean:
      page.verdict(report::VerdictKind::good, "Clean: the model explains the data to what its sensors resolve.");
      break;
    case Diagnosis::Verdict::unknown: {
      std::vector<std::string> lines;
      for (const Unexplained& u : d.unexplained)
        lines.push_back(fmt::format("Joint {}: {}.", u.joint + 1, u.signature));
      page.verdict(report::VerdictKind::bad, "Unknown: " + unknown_headline(d.unexplained) + ".", lines);
      break;
    }
    case Diagnosis::Verdict::effects: {
      std::vector<std::string> lines;
      for (std::size_t i = 0; i < d.effects.size(); ++i) {
        const NamedEffect& e = d.effects[i];
        lines.push_back(
            fmt::format("{}: {} (probability {}).", label_of(e), e.effect.effect->summary(), percent(e.probability)) +
            (i < evaluation.why.size() ? " " + evaluation.why[i] : alternatives_sentence(e)));
      }
      for (const Unexplained& u : d.unexplained)
        lines.push_back(fmt::format("Left unexplained, joint {}: {}.", u.joint + 1, u.signature));
      const bool all_are_sure =
          std::ranges::all_of(d.effects, [](const NamedEffect& e) { return e.probability >= kSure; });
      page.verdict(report::VerdictKind::warning,
                   all_are_sure ? "The model lacks:" : "The model probably lacks:", lines);
      break;
    }
  }
  if (const std::string line = tolerance_line(d); !line.empty()) page.paragraph(line);
}

void add_log_findings(report::Page& page, const Diagnosis& d) {
  std::vector<std::string> suspicious;
  for (const LogFinding& f : d.log_findings)
    if (f.severity == LogFinding::Severity::corrected)
      page.paragraph("Corrected before the diagnosis: " + finding_line(f) + ".");
    else suspicious.push_back(finding_line(f) + ".");
  if (!suspicious.empty())
    page.verdict(report::VerdictKind::warning, "Check the log first. These columns look suspicious:", suspicious);
}

namespace {

ShownUnit position_unit(const Diagnosis& d, int k) {
  const JointUnit unit = joint_units(d.revised)[k];
  return {unit.shown, unit.shown_per_si};
}

}  // namespace

void add_error_table(report::Page& page, const Diagnosis& d) {
  report::Table table;
  table.caption = "Free prediction: error on the hold-out (" + d.holdout + "), which no fit has seen";
  table.header = {"joint", "position RMS before",     "after", "position peak before",
                  "after", "motor torque RMS before", "after"};
  const auto add = [](std::vector<report::Cell>& row, double before, double after, const ShownUnit& unit) {
    const auto cell = [&](double v) { return std::isfinite(v) ? shown(v, unit) : std::string("no sensor"); };
    row.emplace_back(cell(before));
    row.push_back(report::Cell::of_change(cell(after), before, after));
  };
  for (int k = 0; k < d.revised.n(); ++k) {
    const ShownUnit position = position_unit(d, k);
    std::vector<report::Cell> row = {fmt::format("{}", k + 1)};
    add(row, d.before.joint_rms[k], d.after.joint_rms[k], position);
    add(row, d.before.joint_peak[k], d.after.joint_peak[k], position);
    add(row, d.before.torque_rms[k], d.after.torque_rms[k],
        residual_unit(d.revised.nominal, k, ResidualKind::motor_torque));
    table.rows.push_back(std::move(row));
  }
  page.table(table);
  for (const std::string& line : absent_event_lines(d)) page.paragraph(line);
}

void add_error_parts(report::Page& page, const Diagnosis& d) {
  report::Table table;
  table.caption = "The same errors in parts";
  table.header = {"joint", "signal", "model", "bias", "spread", "RMS moving", "RMS resting"};
  table.align = {report::Align::left,  report::Align::left,  report::Align::left, report::Align::right,
                 report::Align::right, report::Align::right, report::Align::right};
  const auto add = [&](int k, const char* signal, const ErrorParts& before, const ErrorParts& after,
                       const ShownUnit& unit) {
    if (!std::isfinite(before.spread[k])) return;
    std::vector<report::Cell> given = {fmt::format("{}", k + 1), signal, "given"}, revised = {"", "", "revised"};
    for (const auto part :
         {&ErrorParts::bias, &ErrorParts::spread, &ErrorParts::moving_rms, &ErrorParts::resting_rms}) {
      const double b = (before.*part)[k], a = (after.*part)[k];
      const auto cell = [&](double v) { return std::isfinite(v) ? shown(v, unit) : std::string("-"); };
      given.emplace_back(cell(b));
      revised.push_back(report::Cell::of_change(cell(a), std::abs(b), std::abs(a)));
    }
    table.rows.push_back(std::move(given));
    table.rows.push_back(std::move(revised));
  };
  for (int k = 0; k < d.revised.n(); ++k) {
    add(k, "position", d.before.joint, d.after.joint, position_unit(d, k));
    add(k, "motor torque", d.before.torque, d.after.torque,
        residual_unit(d.revised.nominal, k, ResidualKind::motor_torque));
  }
  if (table.rows.empty()) return;
  page.table(table);
  page.paragraph(
      "Bias is the mean of measured minus predicted, spread the standard deviation about it. A sample is resting if "
      "the "
      "joint's motor stands still; static friction can then have any value, so the torque says little.");
}

void add_intervals(report::Page& page, const Diagnosis& d) {
  report::Table table;
  table.caption = "95 % interval of the joint position that the revised model predicts on the hold-out";
  table.header = {"joint", "half-width (median)", "samples inside"};
  std::vector<report::Chart> charts;
  for (int k = 0; k < d.revised.n(); ++k) {
    const double half = d.joint_interval.half_width[k];
    if (!std::isfinite(half)) continue;
    table.rows.push_back({fmt::format("{}", k + 1), shown(half, position_unit(d, k)),
                          fmt::format("{:.1f} %", 100 * d.joint_interval.coverage[k])});
    charts.push_back(interval_chart(d, k));
  }
  if (table.rows.empty()) return;
  page.table(table);
  page.paragraph(
      "The interval contains the uncertainty of the fitted parameters and the errors that remain on the training data. "
      "If far fewer than 95 % of the samples lie inside, the model has errors on the hold-out that the training data "
      "do "
      "not show.");
  page.figure_row(charts);
}

void add_estimator_errors(report::Page& page, const ArmModel& model, const DiagnosisEvaluation& evaluation) {
  if (evaluation.estimators.empty()) return;
  add_estimator_table(
      page, model, evaluation.estimators, "revised",
      "Estimators on the hold-out, from motor signals and the load on the joint where it was measured: error of the "
      "joint position");
  std::string innovations;
  for (const EstimatorComparison& e : evaluation.estimators)
    if (e.before.mean_nis > 0 && e.after.mean_nis > 0)
      innovations += fmt::format("{}{} {:.2f} with the given, {:.2f} with the revised model",
                                 innovations.empty() ? "" : "; ", e.name, e.before.mean_nis, e.after.mean_nis);
  if (!innovations.empty())
    page.paragraph(
        "Innovations, mean of their squares over their predicted variance: " + innovations +
        ". It is 1 if model and noise are right, and less if there is less noise than the filter assumes, as in "
        "simulations. A 1 does not show that a model is right: the innovations are those of the motors, and a filter "
        "takes what it lacks for noise.");
}

void write_diagnosis(OutputFiles& files, const std::filesystem::path& folder, const ArmModel& model, const Diagnosis& d,
                     const DiagnosisEvaluation& evaluation) {
  files.add(folder / "model.xml", model_to_xml(d.is_revised() ? d.revised : model));
  files.add(folder / "diagnosis.json", diagnosis_json(d, evaluation));
  files.add(folder / "report.html", diagnosis_page(model, d, evaluation).html());
}

}  // namespace halyard
