#include "app/commands/diagnose_command.h"

#include <fmt/core.h>

#include <cmath>

#include "app/log_input.h"
#include "app/output_check.h"
#include "app/pages/diagnosis/diagnosis_output.h"
#include "app/pages/diagnosis/rehearsal_output.h"
#include "app/progress.h"
#include "app/terminal/terminal.h"
#include "diagnosis/diagnose.h"
#include "diagnosis/explanation/estimates.h"
#include "diagnosis/explanation/view_sentence.h"
#include "evaluation/joint_unit.h"
#include "model/arm_log.h"
#include "model/model_file.h"

namespace halyard {
namespace {

Log read(const ArmModel& model, const std::filesystem::path& path) {
  Log log = read_log_of(model, path, {}, /*torque_required=*/false);
  for (const std::string& note : {ignored_columns_note(log), missing_torques_note(log, model)})
    if (!note.empty()) print_out("{}\n", note);
  return log;
}

/// With their usual times, s: measured on a 30 s log of three joints with one effect.
std::vector<UsualStage> usual_stages(int rehearsals) {
  constexpr double kRehearsal = 6;
  return {{"nominal model", 0.7},
          {"candidates", 2.2},
          {"fits", 0.3},
          {"best candidates", 0.9},
          {"finalists", 0.4},
          {"several effects at once", 0.3},
          {"wider tolerances", 0.2},
          {"final fit", 0.6},
          {"hold-out", 0.2},
          {"what these data could show", 0.4},
          {"residuals that point", 0.1},
          {"estimators on the hold-out", 1.0},
          {"rehearsals", kRehearsal * rehearsals}};
}

/// "0.0002 m", and "0.85" of a number without a unit. digits: how many.
std::string with_unit(double value, int digits, const std::string& unit) {
  return fmt::format("{:.{}g}{}", value, digits, unit == "1" ? "" : " " + unit);
}

/// Nothing of a whole number.
std::string interval_in_brackets(const Estimated& p) {
  return p.is_whole ? "" : fmt::format(" (95 %: {:.4g} to {:.4g})", p.lower, p.upper);
}

/// Alternatives that are less probable are in the files only.
constexpr double kWorthALine = 0.01;

void print_findings(const Diagnosis& d, const DiagnosisEvaluation& evaluation) {
  print_out("{}\n", verdict_line(d));
  for (const NamedEffect& e : d.effects)
    for (const Estimated& p : e.parameters)
      if (!p.is_reset)
        print_out("  {} {}: {}{}\n", label_of(e), p.name, with_unit(p.value, 4, p.unit), interval_in_brackets(p));
  for (const NamedEffect& e : d.effects)
    for (const Alternative& a : e.alternatives)
      if (a.probability >= kWorthALine)
        print_out("  {}: or {} ({})\n", effect_label(e.effect), effect_label(a.effect), percent(a.probability));
  for (std::size_t i = 0; i < d.effects.size(); ++i)
    print_out("  {}: {}\n", effect_label(d.effects[i].effect), evaluation.why[i]);
  for (const Estimated& p : d.refitted)
    print_out("  refitted {}: {:.5g} -> {}\n", p.name, p.nominal, with_unit(p.value, 5, p.unit));
  for (const std::string& line : bound_lines(d)) print_out("  {}\n", line);
  if (const std::string line = tolerance_line(d); !line.empty()) print_out("  {}\n", line);
  for (const LogFinding& f : d.log_findings) print_out("  {}: {}\n", severity_word(f.severity), finding_line(f));
  for (const Unexplained& u : d.unexplained) print_out("  unexplained, joint {}: {}\n", u.joint + 1, u.signature);
}

void print_rehearsals(const Diagnosis& d, const Rehearsals& r) {
  print_out("  rehearsed {} times (seed {}):\n", r.all.size(), r.seed);
  for (const std::string& line : rehearsal_lines(r)) print_out("    {}\n", line);
  for (const NamedEffect& e : d.effects)
    print_out("    {}: {} with these rehearsals\n", label_of(e), percent(r.calibrated(e.probability)));
}

/// Of the given and of the revised model on the hold-out, joint by joint.
void print_errors(const ArmModel& model, const Diagnosis& d, const DiagnosisEvaluation& evaluation) {
  for (const std::string& line : absent_event_lines(d)) print_out("  {}\n", line);
  const std::vector<JointUnit> units = joint_units(model);
  for (int k = 0; k < model.n(); ++k) {
    const auto print = [k](const std::string& what, double before, double after, const ShownUnit& unit) {
      if (std::isfinite(before))
        print_out("  joint {} {} RMS on the hold-out: {:.4g} -> {:.4g} {}\n", k + 1, what, unit.per_si * before,
                  unit.per_si * after, unit.name);
    };
    const ShownUnit position{units[k].shown, units[k].shown_per_si};
    print("position", d.before.joint_rms[k], d.after.joint_rms[k], position);
    print("motor torque", d.before.torque_rms[k], d.after.torque_rms[k],
          residual_unit(model.nominal, k, ResidualKind::motor_torque));
    for (const EstimatorComparison& e : evaluation.estimators)
      if (d.is_revised() && !e.before.rms.empty() && !e.after.rms.empty())
        print(e.name + " position", e.before.rms[k], e.after.rms[k], position);
  }
  for (const EstimatorComparison& e : evaluation.estimators) {
    if (!e.before.failure.empty()) print_out("  {} failed with the given model: {}\n", e.name, e.before.failure);
    if (!e.after.failure.empty()) print_out("  {} failed with the revised model: {}\n", e.name, e.after.failure);
  }
}

}  // namespace

void run_diagnose(const DiagnoseCommandOptions& options) {
  const auto lock = lock_output_folder(options.out);
  ArmModel model = read_model(options.model);
  model.columns = columns_of(model, options.columns);  // the model that is written reads the same logs
  std::vector<std::filesystem::path> all = options.data;
  if (!options.holdout.empty()) all.push_back(options.holdout);
  check_given_once(all);
  std::vector<Log> training;
  for (const auto& path : options.data) training.push_back(read(model, path));
  std::optional<Log> holdout;
  if (!options.holdout.empty()) holdout = read(model, options.holdout);
  check_not_input(options.out / "model.xml");

  Diagnosis d;
  DiagnosisEvaluation evaluation;
  const auto write = [&] {
    OutputFiles files;
    write_diagnosis(files, options.out, model, d, evaluation);
    commit_outputs(files);
  };
  {
    StageProgress progress("diagnose", usual_stages(options.rehearsals),
                           options.progress_in_pipe ? PipedProgress::lines : PipedProgress::nothing);
    const auto tell = [&](const std::string& what, double fraction) { progress.set(what, fraction); };
    d = diagnose(model, training, holdout, {}, tell);
    evaluation = evaluate_diagnosis(model, d, training, holdout, tell);
    write();
    if (options.rehearsals > 0) {
      evaluation.rehearsals = rehearse(model, d, training, holdout, {options.rehearsals, options.seed}, {}, tell);
      write();
    }
  }
  print_findings(d, evaluation);
  print_errors(model, d, evaluation);
  if (evaluation.rehearsals) print_rehearsals(d, *evaluation.rehearsals);
  print_out("model: {}\n", (options.out / "model.xml").string());
  print_out("report: {}\n", (options.out / "report.html").string());
}

}  // namespace halyard
