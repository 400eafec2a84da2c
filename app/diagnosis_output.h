#pragma once
/// What a diagnosis is told as: diagnosis.json, report.html and lines on the terminal.

#include <string>

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

/// The whole report.
report::Page diagnosis_page(const ArmModel& model, const Diagnosis& diagnosis);

}  // namespace halyard
