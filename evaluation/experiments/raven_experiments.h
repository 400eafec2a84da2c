#pragma once
/// The paper's experiments A (high tension), B (low tension) and C (payload) on a simulated RAVEN-II, beside what the
/// paper measured on the robot. The true robot, raven2_likely.xml, has effects that the estimators' model, raven2.xml,
/// lacks, as the paper's robot probably had.

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "evaluation/comparison/compare.h"
#include "evaluation/studies/effect_study.h"
#include "plant/scenario.h"

namespace halyard {

/// Mean absolute errors that were measured on the robot: Table IV of Haghighipanah, Li, Miyasaka, Hannaford, IROS 2015,
/// and what came after it.
struct PublishedErrors {
  const char* source;
  std::array<double, 3> error;  ///< joint 1 deg, joint 2 deg, joint 3 mm
};
/// The paper's kinematics first, its filter second.
const std::vector<PublishedErrors>& published_errors();

/// Gain of the filter over kinematics that Table III of the paper gives for joint 2: experiments A, B, C. Its other
/// entries are not known here.
inline constexpr double kTableThreeJointTwoGain[] = {0.46, 0.047, 0.39};

struct ExperimentsSetup {
  std::filesystem::path raven2;           ///< folder of models and scenarios
  std::filesystem::path calibrated = {};  ///< a model that estimators are run with too; empty: calibrate()'s
  double duration_s = 0;                  ///< in place of the scenarios' own; 0: theirs
};

struct Experiment {
  std::string name;            ///< of the scenario
  ArmModel robot;              ///< the true one
  ArmModel model, calibrated;  ///< what the estimators believe
  Signals desired;             ///< [joint] what the joints were asked for
  Comparison comparison;
};

/// experiment_a.xml, experiment_b.xml and experiment_c.xml with raven2_likely.xml as the true robot. Throws as
/// read_scenario does.
std::vector<Scenario> experiment_scenarios(const ExperimentsSetup& setup);

/// raven2.xml with couplings that a dual filter identified, as the paper's did, with joint sensors and in another
/// motion: calibration.xml, with the same true robot. They are those that the dual filter ends with. halyard identify
/// goes on to estimate the model's other numbers along, within their tolerances, and this robot's are beyond them.
/// Throws as read_scenario, simulate and identify do.
ArmModel calibrate(const ExperimentsSetup& setup);

/// Simulates the experiments in parallel and runs the built-in estimators over each, with raven2.xml and with the
/// calibrated model. progress(fraction) may be called from any thread.
/// Throws InputError if a model has not three joints, and as read_scenario, simulate and compare_estimators do.
std::vector<Experiment> compute_experiments(const ExperimentsSetup& setup,
                                            const std::function<void(double)>& progress = {});

/// Which of the robot's effects makes how much of the errors of kinematics and sr_ukf with raven2.xml.
EffectStudy study_experiments(const ExperimentsSetup& setup, const std::function<void(double)>& progress = {});

/// Mean of the mean absolute errors of a joint over the experiments, SI.
double mean_error(const std::vector<Experiment>& experiments, std::size_t run, int k);

/// Gain of a run over kinematics, 1 - error / that of kinematics, of the means over the experiments.
double mean_gain(const std::vector<Experiment>& experiments, std::size_t run, int k);

/// The place of a run in every experiment; that of kinematics and the filter are always there.
std::size_t run_named(const std::vector<Experiment>& experiments, const std::string& name);

}  // namespace halyard
