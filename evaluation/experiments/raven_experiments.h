#pragma once
/// The paper's experiments A (high tension), B (low tension) and C (payload) on a simulated RAVEN-II, for comparison
/// with the paper's measurements. The true robot, raven2_likely.xml, has effects that the paper's robot probably had.
/// The estimators' model, raven2.xml, lacks them.

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "evaluation/comparison/compare.h"
#include "evaluation/studies/effect_study.h"
#include "plant/scenario.h"

namespace halyard {

/// Mean absolute errors measured on the robot: Table IV of Haghighipanah, Li, Miyasaka, Hannaford, IROS 2015, and later
/// publications.
struct PublishedErrors {
  const char* source;
  std::array<double, 3> error;  ///< joint 1 deg, joint 2 deg, joint 3 mm
};
/// All published errors; the first is the paper's kinematics, the second the paper's filter.
const std::vector<PublishedErrors>& published_errors();

/// Improvement of the filter over kinematics for joint 2 in Table III of the paper: experiments A, B, C. The table's
/// other entries are not available.
inline constexpr double kTableThreeJointTwoGain[] = {0.46, 0.047, 0.39};

struct ExperimentsSetup {
  std::filesystem::path raven2;           ///< folder of models and scenarios
  std::filesystem::path calibrated = {};  ///< second model of the estimators; empty: the result of calibrate()
  double duration_s = 0;                  ///< replaces the durations of the scenarios; 0: they are kept
};

struct Experiment {
  std::string name;            ///< of the scenario
  ArmModel robot;              ///< the true robot
  ArmModel model, calibrated;  ///< the estimators' models
  Signals desired;             ///< [joint] commanded trajectory, rad | m
  Comparison comparison;
};

/// experiment_a.xml, experiment_b.xml and experiment_c.xml with raven2_likely.xml as the true robot. Throws as
/// read_scenario does.
std::vector<Scenario> experiment_scenarios(const ExperimentsSetup& setup);

/// raven2.xml with couplings identified by a dual filter, as in the paper. The data are a simulation of the same true
/// robot with joint sensors in another motion, calibration.xml. The couplings are the dual filter's final estimates.
/// The second stage of identify() is not used: it estimates the other parameters within their tolerances, but the
/// parameters of this robot differ from the model by more than their tolerances. Throws as read_scenario, simulate and
/// identify do.
ArmModel calibrate(const ExperimentsSetup& setup);

/// Simulates the experiments in parallel and runs the built-in estimators over each, with raven2.xml and with the
/// calibrated model. progress(fraction) may be called from any thread.
/// Throws InputError if a model does not have three joints. Also throws as read_scenario, simulate and
/// compare_estimators do.
std::vector<Experiment> compute_experiments(const ExperimentsSetup& setup,
                                            const std::function<void(double)>& progress = {});

/// Contribution of each of the robot's effects to the errors of kinematics and sr_ukf with raven2.xml.
EffectStudy study_experiments(const ExperimentsSetup& setup, const std::function<void(double)>& progress = {});

/// Mean absolute error of joint k (0-based) in a run, averaged over the experiments, SI.
double mean_error(const std::vector<Experiment>& experiments, std::size_t run, int k);

/// Improvement of a run over kinematics: 1 - error / error of kinematics, with errors from mean_error().
double mean_gain(const std::vector<Experiment>& experiments, std::size_t run, int k);

/// Index of the run with this name; it is the same in every experiment. Kinematics and the filter always have one.
std::size_t run_named(const std::vector<Experiment>& experiments, const std::string& name);

}  // namespace halyard
