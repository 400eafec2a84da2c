#include "app/pages/identify_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/pages/comparison_output.h"
#include "evaluation/csv.h"
#include "evaluation/json.h"
#include "model/model_file.h"
#include "model/output_file.h"

namespace halyard {
namespace {

constexpr double kWorse = 1.1;  // an error that has grown by more has grown

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

void write_convergence(const std::filesystem::path& path, const Identification& identification) {
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
  table.write(path);
}

/// The estimator whose errors on the hold-out decide.
const EstimatorComparison& judge_of(const IdentifyResult& result) {
  return *std::ranges::find(result.estimators, "sr_ukf", &EstimatorComparison::name);
}

/// RMS error of joint k with the identified numbers over that with the given; 1 where it is not known.
double growth(const EstimatorComparison& e, int k) {
  if (e.before.rms.empty() || e.after.rms.empty()) return 1;
  const double ratio = e.after.rms[k] / e.before.rms[k];
  return std::isfinite(ratio) ? ratio : 1;
}

/// "joint 2 by 2 times, joint 3 by 1.2 times": joints whose error has grown.
std::string worse_joints(const IdentifyResult& result) {
  std::string text;
  for (int k = 0; k < result.given.n(); ++k)
    if (const double ratio = growth(judge_of(result), k); ratio > kWorse)
      text += fmt::format("{}joint {} by {:.2g} times", text.empty() ? "" : ", ", k + 1, ratio);
  return text;
}

}  // namespace

bool adopted(const IdentifyResult& result) {
  const EstimatorComparison& judge = judge_of(result);
  if (judge.before.failure.empty() && !judge.after.failure.empty()) return false;
  double product = 1;
  for (int k = 0; k < result.given.n(); ++k) product *= growth(judge, k);
  return worse_joints(result).empty() || product <= 1;
}

std::vector<std::string> doubts(const IdentifyResult& result) {
  std::vector<std::string> all;
  constexpr std::size_t kNamed = 4;
  const std::vector<DeviatingNumber>& deviating = result.identification.deviating;
  std::string names;
  for (std::size_t i = 0; i < std::min(kNamed, deviating.size()); ++i)
    names += (i == 0 ? "" : ", ") + fmt::format("{} ({:.3g} instead of {:.3g} {})", deviating[i].name,
                                                deviating[i].value, deviating[i].nominal, deviating[i].unit);
  if (deviating.size() > kNamed) names += fmt::format(" and {} more", deviating.size() - kNamed);
  if (!names.empty())
    all.push_back("the log pulls other numbers beyond twice their tolerance: " + names +
                  "; the model lacks something beside what was asked for, and halyard diagnose tells what");
  if (!result.identification.converged)
    all.push_back("the estimate still moves after the last pass over the data, and is not where its interval says");
  const EstimatorComparison& judge = judge_of(result);
  std::string worse = worse_joints(result);
  if (!judge.after.failure.empty()) worse = fmt::format("fails: {}", judge.after.failure);
  if (!adopted(result))
    all.push_back(
        fmt::format("{} with the identified numbers is worse on the hold-out ({}), so that model.xml keeps "
                    "the given ones; they stand for something that the model lacks, and halyard diagnose "
                    "tells what",
                    judge.name, worse));
  else if (!worse.empty())
    all.push_back(fmt::format("{} with the identified numbers is not better at all joints of the hold-out ({})",
                              judge.name, worse));
  return all;
}

std::string identify_json(const IdentifyResult& result) {
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
      {"strained", deviating},
      {"error", {{"holdout", result.holdout}, {"joint_position_rms", rms}, {"joint_position_peak", peak}}}};
  return json_text(all);
}

void write_identification(const std::filesystem::path& folder, const IdentifyResult& result) {
  const report::Page page = identify_page(result);
  write_file_whole(folder / "model.xml", model_to_xml(adopted(result) ? result.identification.model : result.given));
  write_file_whole(folder / "identify.json", identify_json(result));
  write_convergence(folder / "convergence.csv", result.identification);
  page.write(folder / "report.html");
}

}  // namespace halyard
