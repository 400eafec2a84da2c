#include "app/pages/identify_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/pages/comparison_output.h"
#include "evaluation/csv.h"
#include "evaluation/json.h"
#include "model/model_file.h"

namespace halyard {
namespace {

using Json = nlohmann::ordered_json;

const char* word(Convergence convergence) {
  switch (convergence) {
    case Convergence::converged: return "converged";
    case Convergence::drifting: return "drifting";
    case Convergence::not_excited: break;
  }
  return "not excited";
}

Json numbers(const std::vector<double>& values) {
  Json all = Json::array();
  for (const double v : values) all.push_back(number_or_null(v));
  return all;
}

std::string convergence_csv(const Identification& identification) {
  std::vector<std::string> header = {"time"};
  for (const IdentifiedNumber& number : identification.numbers) {
    header.push_back(number.key);
    header.push_back(number.key + ".std");
  }
  CsvTable table(header, "halyard identify, the dual filter's estimates; SI units");
  for (std::size_t i = 0; i < identification.time.size(); ++i) {
    table.add_time(identification.time[i]);
    for (const IdentifiedNumber& number : identification.numbers) {
      table.add(number.trace[i]);
      table.add(number.trace_std[i]);
    }
  }
  return table.text();
}

}  // namespace

std::string identify_json(const IdentificationStudy& result) {
  const Identification& found = result.identification;
  Json parameters = Json::array(), deviating = Json::array(), rms = Json::object(), peak = Json::object();
  for (const IdentifiedNumber& n : found.numbers)
    parameters.push_back({{"name", n.name},
                          {"key", n.key},
                          {"joint", n.joint + 1},
                          {"unit", n.unit},
                          {"from", number_or_null(n.nominal)},
                          {"value", number_or_null(n.value)},
                          {"ci95", numbers({n.lower, n.upper})},
                          {"convergence", word(n.convergence)}});
  for (const DeviatingNumber& s : found.deviating)
    deviating.push_back({{"name", s.name},
                         {"unit", s.unit},
                         {"from", number_or_null(s.nominal)},
                         {"value", number_or_null(s.value)},
                         {"tolerances", number_or_null(s.tolerances)}});
  for (const EstimatorComparison& e : result.estimators) {
    const auto both = [](const std::vector<double>& before, const std::vector<double>& after) {
      return Json{{"before", numbers(before)}, {"after", numbers(after)}};
    };
    rms[e.name] = both(e.before.rms, e.after.rms);
    peak[e.name] = both(e.before.peak, e.after.peak);
  }
  const Json all = {
      {"adopted", adopted(result)},
      {"doubts", doubts(result)},
      {"parameters", parameters},
      {"blocks", found.blocks},
      {"process_noise", found.disturbances},
      {"strained", deviating},
      {"error", {{"holdout", result.holdout}, {"joint_position_rms", rms}, {"joint_position_peak", peak}}}};
  return json_text(all);
}

void write_identification(OutputFiles& files, const std::filesystem::path& folder, const IdentificationStudy& result) {
  files.add(folder / "model.xml", model_to_xml(adopted(result) ? result.identification.model : result.given));
  files.add(folder / "identify.json", identify_json(result));
  files.add(folder / "convergence.csv", convergence_csv(result.identification));
  files.add(folder / "report.html", identify_page(result).html());
}

}  // namespace halyard
