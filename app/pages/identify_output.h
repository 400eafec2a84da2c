#pragma once
/// Output of an identification: identify.json, convergence.csv, report.html and sentences.

#include <filesystem>
#include <string>

#include "app/report/page.h"
#include "evaluation/studies/identification_study.h"
#include "model/output/output_files.h"

namespace halyard {

/// "converged", or a phrase that says what is wrong and what to do about it.
std::string in_words(Convergence convergence);

/// The text of identify.json.
std::string identify_json(const IdentificationStudy& result);

report::Page identify_page(const IdentificationStudy& result);

/// Adds model.xml, identify.json, convergence.csv and report.html into the folder. model.xml is the identified model
/// if adopted() is true, otherwise the given model.
void write_identification(OutputFiles& files, const std::filesystem::path& folder, const IdentificationStudy& result);

}  // namespace halyard
