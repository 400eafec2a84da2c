#pragma once
/// What a diagnosis is told as: diagnosis.json, report.html and lines on the terminal.

#include <filesystem>
#include <string>
#include <vector>

#include "app/report/page.h"
#include "diagnosis/diagnose.h"

namespace halyard {

/// The text of diagnosis.json.
std::string diagnosis_json(const Diagnosis& diagnosis);

/// "backlash of joint 2", "payload".
std::string effect_label(const PlacedEffect& effect);

/// "effects: backlash of joint 2", "clean", "unknown".
std::string verdict_line(const Diagnosis& diagnosis);

/// The verdict as a call-out of a page, and the table of errors before and after.
void add_verdict(report::Page& page, const Diagnosis& diagnosis);
void add_error_table(report::Page& page, const Diagnosis& diagnosis);

/// Joint k's residuals on the hold-out before and after: position over time, torque over time, and over the motor's rate,
/// where friction and gaps show as loops. Without a sensor there is no chart of it.
std::vector<report::Chart> residual_charts(const Diagnosis& diagnosis, int k);

/// The whole report.
report::Page diagnosis_page(const ArmModel& model, const Diagnosis& diagnosis);

/// Writes model.xml, diagnosis.json and report.html into the folder; model.xml is the given model if nothing changed.
void write_diagnosis(const std::filesystem::path& folder, const ArmModel& model, const Diagnosis& diagnosis);

}  // namespace halyard
