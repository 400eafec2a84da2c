#include "evaluation/experiments/raven_experiments.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>

#include "estimators/identification/identify.h"
#include "model/input_error.h"
#include "model/machine/first_failure.h"
#include "model/model_file.h"
#include "plant/simulate.h"
#include "plant/trajectory.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

constexpr std::array kFiles = {"experiment_a.xml", "experiment_b.xml", "experiment_c.xml"};
constexpr const char* kCalibration = "calibration.xml";
constexpr const char* kModel = "raven2.xml";
constexpr const char* kRobot = "raven2_likely.xml";

ArmModel read_three_joints(const fs::path& path) {
  ArmModel model = read_model(path);
  if (model.n() != 3) {
    throw InputError(
        fmt::format("{}: has {} joints; the experiments need the RAVEN-II's three", path.string(), model.n()));
  }
  return model;
}

ArmModel read_calibrated(const fs::path& path, const ArmModel& model) {
  ArmModel calibrated = read_three_joints(path);
  if (!joints_alike(calibrated.nominal, model.nominal))
    throw InputError(path.string() +
                     ": its joints are not of the RAVEN-II's types, or one has no motor; give a model "
                     "of this arm with other numbers");
  return calibrated;
}

Signals desired_positions(const Scenario& scenario, const std::vector<double>& time) {
  Signals desired(scenario.trajectory.size());
  for (std::size_t k = 0; k < desired.size(); ++k)
    for (const double t : time) desired[k].push_back(desired_position(scenario.trajectory[k], scenario.fade_in_s, t));
  return desired;
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

std::vector<Scenario> experiment_scenarios(const ExperimentsSetup& setup) {
  std::vector<Scenario> scenarios;
  for (const char* file : kFiles) {
    scenarios.push_back(read_scenario(setup.raven2 / file, setup.raven2 / kRobot));
    if (setup.duration_s > 0) scenarios.back().duration_s = setup.duration_s;
  }
  return scenarios;
}

ArmModel calibrate(const ExperimentsSetup& setup) {
  ArmModel model = read_three_joints(setup.raven2 / kModel);
  Log log = simulate(read_scenario(setup.raven2 / kCalibration, setup.raven2 / kRobot)).measured;
  log.source = kCalibration;
  const Identification found = identify(model, {log}, identified_keys(model, "coupling"));
  for (const ParameterInfo& p : named_parameters(model.nominal)) {
    const auto number = std::ranges::find(found.numbers, p.key, &IdentifiedNumber::key);
    if (number != found.numbers.end()) p.number.set(number->trace.back());
  }
  return model;
}

std::vector<Experiment> compute_experiments(const ExperimentsSetup& setup,
                                            const std::function<void(double)>& progress) {
  const ArmModel model = read_three_joints(setup.raven2 / kModel);
  const std::vector<Scenario> scenarios = experiment_scenarios(setup);
  ArmModel calibrated;
  std::vector<SimulationResult> data(scenarios.size());
  std::vector<std::atomic<double>> simulated(scenarios.size()), estimated(scenarios.size());
  const auto tell = [&](std::atomic<double>& done, double fraction) {
    done = fraction;
    double sum = 0;
    for (std::size_t i = 0; i < scenarios.size(); ++i) sum += simulated[i] + estimated[i];
    if (progress) progress(sum / double(2 * scenarios.size()));
  };
  for_each_in_parallel(scenarios.size() + 1, [&](std::size_t job) {
    if (job == 0) {
      calibrated = setup.calibrated.empty() ? calibrate(setup) : read_calibrated(setup.calibrated, model);
      return;
    }
    const std::size_t i = job - 1;
    data[i] = simulate(scenarios[i], [&](double fraction) { tell(simulated[i], fraction); });
    data[i].measured.source = kFiles[i];
  });

  const std::vector<Contestant> contestants = {{"kinematics", &model, "kinematics"},
                                               {"kinematics", &calibrated, "kinematics, calibrated"},
                                               {"ekf", &model, "ekf"},
                                               {"sr_ukf", &model, "sr_ukf"},
                                               {"sr_ukf", &calibrated, "sr_ukf, calibrated"}};
  std::vector<Experiment> experiments(scenarios.size());
  for_each_in_parallel(scenarios.size(), [&](std::size_t i) {
    CompareOptions options;
    options.progress = [&](double fraction) { tell(estimated[i], fraction); };
    experiments[i] = {scenarios[i].name,
                      scenarios[i].robot,
                      model,
                      calibrated,
                      desired_positions(scenarios[i], data[i].truth.time),
                      compare_estimators(contestants, data[i].measured, data[i].truth, options)};
    experiments[i].comparison.data = kFiles[i];
    experiments[i].comparison.model = kModel;
    experiments[i].comparison.truth_from = "truth of the simulation";
  });
  return experiments;
}

EffectStudy study_experiments(const ExperimentsSetup& setup, const std::function<void(double)>& progress) {
  return study_effects(experiment_scenarios(setup), read_three_joints(setup.raven2 / kModel), {"kinematics", "sr_ukf"},
                       CompareOptions{}.skip_s, progress);
}

double mean_error(const std::vector<Experiment>& experiments, std::size_t run, int k) {
  double sum = 0;
  for (const Experiment& experiment : experiments) sum += experiment.comparison.errors[run][k].mean_absolute;
  return sum / double(experiments.size());
}

double mean_gain(const std::vector<Experiment>& experiments, std::size_t run, int k) {
  return 1 - mean_error(experiments, run, k) / mean_error(experiments, run_named(experiments, "kinematics"), k);
}

std::size_t run_named(const std::vector<Experiment>& experiments, const std::string& name) {
  const auto& runs = experiments.front().comparison.runs;
  return std::size_t(std::ranges::find(runs, name, &EstimatorRun::name) - runs.begin());
}

}  // namespace halyard
