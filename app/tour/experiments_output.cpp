#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "app/pages/comparison_output.h"
#include "app/tour/experiments_report.h"
#include "evaluation/json.h"

namespace halyard {
namespace {

using nlohmann::ordered_json;

const Comparison& first(const std::vector<Experiment>& experiments) { return experiments.front().comparison; }

ordered_json study_json(const EffectStudy& study) {
  ordered_json all = ordered_json::array();
  for (const StudiedRobot& robot : study.robots) {
    ordered_json errors;
    for (std::size_t e = 0; e < study.estimators.size(); ++e) {
      errors[study.estimators[e]] = ordered_json::array();
      for (const double error : robot.error[e]) errors[study.estimators[e]].push_back(number_or_null(error));
    }
    all.push_back({{"effects", robot.name()}, {"mean_absolute_error", errors}});
  }
  return all;
}

ordered_json experiments_json(const std::vector<Experiment>& experiments, const std::optional<EffectStudy>& study) {
  const Comparison& comparison = first(experiments);
  ordered_json means = ordered_json::array(), published = ordered_json::array(), details = ordered_json::array();
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    ordered_json errors = ordered_json::array(), gains = ordered_json::array();
    for (int k = 0; k < comparison.n_joints(); ++k) {
      errors.push_back(number_or_null(mean_error(experiments, i, k)));
      gains.push_back(number_or_null(mean_gain(experiments, i, k)));
    }
    means.push_back({{"estimator", comparison.runs[i].name},
                     {"mean_absolute_error", errors},
                     {"improvement_over_kinematics", gains}});
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
  ordered_json all = {{"mean_of_experiments", means}, {"measured_on_the_robot", published}, {"experiments", details}};
  if (study) all["effect_study"] = study_json(*study);
  return all;
}

CsvTable experiments_csv(const std::vector<Experiment>& experiments) {
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

CsvTable study_csv(const EffectStudy& study, const std::vector<JointUnit>& units) {
  CsvTable table({"effects", "estimator", "joint", "unit", "mean_absolute_error"});
  for (const StudiedRobot& robot : study.robots)
    for (std::size_t e = 0; e < study.estimators.size(); ++e)
      for (std::size_t k = 0; k < units.size(); ++k) {
        for (const std::string& text : {robot.name(), study.estimators[e], std::to_string(k + 1), units[k].si})
          table.add(text);
        table.add(robot.error[e][k]);
      }
  return table;
}

}  // namespace

void write_experiments(OutputFiles& files, const std::filesystem::path& folder,
                       const std::vector<Experiment>& experiments, const std::optional<EffectStudy>& study) {
  files.add(folder / "experiments.csv", experiments_csv(experiments).text());
  if (study) files.add(folder / "effects.csv", study_csv(*study, first(experiments).units).text());
  else if (std::filesystem::exists(folder / "experiments.json"))
    files.remove(folder / "effects.csv");  // of an earlier run
  files.add(folder / "experiments.json", json_text(experiments_json(experiments, study)));
  files.add(folder / "report.html", experiments_page(experiments, study).html());
}

}  // namespace halyard
