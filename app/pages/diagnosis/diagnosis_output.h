#pragma once
/// Output of a diagnosis: diagnosis.json, report.html and lines on the terminal.

#include <filesystem>
#include <string>
#include <vector>

#include "app/pages/diagnosis/name_text.h"
#include "app/report/page.h"
#include "diagnosis/diagnose.h"
#include "evaluation/studies/diagnosis_evaluation.h"
#include "model/output/output_files.h"

namespace halyard {

/// The text of diagnosis.json.
std::string diagnosis_json(const Diagnosis& diagnosis, const DiagnosisEvaluation& evaluation);

/// A sentence about each event that did not happen in the hold-out.
std::vector<std::string> absent_event_lines(const Diagnosis& diagnosis);

/// The verdict, and the names with their probabilities: "effects: backlash of joint 2 (97 %)", "clean", "unknown".
std::string verdict_line(const Diagnosis& diagnosis);

/// A sentence about a model that is off by more than its tolerances; empty if it is not.
std::string tolerance_line(const Diagnosis& diagnosis);

/// The verdict as a call-out of a page, with the reasons if there is an evaluation.
void add_verdict(report::Page& page, const Diagnosis& diagnosis, const DiagnosisEvaluation& evaluation = {});
/// Suspicious findings about the logs as a call-out; nothing if there are none.
void add_log_findings(report::Page& page, const Diagnosis& diagnosis);
/// Errors of the prediction from the motors' motion alone: on the hold-out, with the given and with the revised model.
void add_error_table(report::Page& page, const Diagnosis& diagnosis);
/// These errors as bias and spread, and of moving and resting samples. Adds nothing if nothing is compared.
void add_error_parts(report::Page& page, const Diagnosis& diagnosis);
/// 95 % intervals of the predicted joint positions, and how many samples they contain. Adds nothing without joint
/// sensors.
void add_intervals(report::Page& page, const Diagnosis& diagnosis);
/// Errors of the estimators with the given and with the revised model, and results from their innovations. Adds nothing
/// without an evaluation.
void add_estimator_errors(report::Page& page, const ArmModel& model, const DiagnosisEvaluation& evaluation);

/// Joint k's residuals on the hold-out, with the given and with the revised model: position over time, torque over
/// time, and position over the motor's rate, where friction and gaps show as loops. Without a joint sensor there are no
/// charts of the position, and the torque is drawn over the motor's rate.
std::vector<report::Chart> residual_charts(const Diagnosis& diagnosis, int k);

/// Joint k's position error by the revised model over time, between the ends of its 95 % interval.
report::Chart interval_chart(const Diagnosis& diagnosis, int k);

/// The whole report.
report::Page diagnosis_page(const ArmModel& model, const Diagnosis& diagnosis, const DiagnosisEvaluation& evaluation);

/// Adds model.xml, diagnosis.json and report.html into the folder; model.xml is the given model if nothing changed.
/// Without an evaluation the report has no reasons and no estimators.
void write_diagnosis(OutputFiles& files, const std::filesystem::path& folder, const ArmModel& model,
                     const Diagnosis& diagnosis, const DiagnosisEvaluation& evaluation = {});

}  // namespace halyard
