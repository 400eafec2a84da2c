#include "app/experiments.h"

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include <atomic>
#include <numeric>

#include "model/input_error.h"
#include "model/model_file.h"
#include "plant/scenario.h"
#include "plant/simulate.h"

namespace halyard {
namespace {

const std::vector<std::string> kEstimators = {"kinematics", "ekf", "sr_ukf"};

using StageCallback = std::function<void(const std::string&, double)>;

std::vector<SimulationResult> simulate_all(const std::vector<Scenario>& scenarios, const StageCallback& progress) {
  std::vector<SimulationResult> results(scenarios.size());
  std::vector<std::atomic<double>> done(scenarios.size());
  oneapi::tbb::parallel_for(std::size_t{0}, scenarios.size(), [&](std::size_t i) {
    results[i] = simulate(scenarios[i], [&](double fraction) {
      done[i] = fraction;
      if (progress) progress("simulate", std::accumulate(done.begin(), done.end(), 0.0) / double(done.size()));
    });
  });
  return results;
}

}  // namespace

const std::vector<PublishedErrors>& published_errors() {
  static const std::vector<PublishedErrors> errors = {
      {"paper, Table IV, kinematics", {1.3134, 2.6383, 2.507}},
      {"paper, Table IV, UKF", {1.2946, 1.6685, 0.928}},
      {"neural network trained with joint encoders (arXiv 2408.01604)", {0.104, 0.120, 0.118}},
  };
  return errors;
}

std::vector<Experiment> compute_experiments(const std::filesystem::path& raven2_folder, const StageCallback& progress) {
  const std::vector<std::string> files = {"experiment_a.xml", "experiment_b.xml", "experiment_c.xml"};
  std::vector<Scenario> scenarios;
  for (const std::string& file : files) scenarios.push_back(read_scenario(raven2_folder / file));
  const ArmModel model = read_model(raven2_folder / "raven2.xml");
  if (model.n() != 3) {
    throw InputError(
        fmt::format("{}: has {} joints; the experiments need the RAVEN-II's three", model.source, model.n()));
  }
  const std::vector<SimulationResult> data = simulate_all(scenarios, progress);

  std::vector<Experiment> experiments;
  for (std::size_t i = 0; i < files.size(); ++i) {
    Log measured = data[i].measured;
    measured.source = files[i];
    CompareOptions options;
    options.progress = [&](double fraction) {
      if (progress) progress("estimate", (double(i) + fraction) / double(files.size()));
    };
    Experiment experiment{scenarios[i].name, compare_estimators(model, kEstimators, measured, data[i].truth, options)};
    experiment.comparison.data = files[i];
    experiment.comparison.model = "raven2.xml";
    experiment.comparison.truth_from = "truth of the simulation";
    experiments.push_back(std::move(experiment));
  }
  return experiments;
}

double mean_error(const std::vector<Experiment>& experiments, std::size_t run, int k) {
  double sum = 0;
  for (const Experiment& experiment : experiments) sum += experiment.comparison.errors[run][k].mean_absolute;
  return sum / double(experiments.size());
}

}  // namespace halyard
