/// Studies hand ContainmentOptions on to the estimators: with in_process they need no worker.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <limits>
#include <memory>

#include "diagnosis/diagnosis_details.h"
#include "evaluation/comparison/compare.h"
#include "evaluation/comparison/monte_carlo.h"
#include "evaluation/joint_unit.h"
#include "evaluation/studies/diagnosis_evaluation.h"
#include "evaluation/studies/identification_study.h"
#include "evaluation/sweep/sweep_run.h"
#include "model/homing.h"
#include "plant/simulate.h"
#include "tests/support/environment.h"
#include "tests/support/message_of.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNoWorker = "HALYARD_WORKER: '/no/such/program' is no file; give the path of halyard_worker";

/// An arm of two joints that moves. No worker can be started.
class InProcess : public testing::Test {
 protected:
  Log log_of(double duration_s) {
    scenario.duration_s = duration_s;
    return simulate(scenario).measured;
  }

  void expect_runs(const std::vector<EstimatorComparison>& estimators) const {
    ASSERT_FALSE(estimators.empty());
    for (const EstimatorComparison& e : estimators)
      for (const EstimatorErrors& errors : {e.before, e.after}) {
        EXPECT_EQ(errors.failure, "") << e.name;
        EXPECT_EQ(std::ssize(errors.rms), scenario.robot.n()) << e.name;
      }
  }

  Scenario scenario = motion(first_joints(2), 1);
  const Environment worker{"HALYARD_WORKER", "/no/such/program"};
};

TEST_F(InProcess, AMonteCarloStudyNeedsNoWorker) {
  const auto study = [&](bool in_process) {
    return run_monte_carlo(scenario, scenario.robot, {"kinematics"},
                           {.runs = 2, .containment = {.in_process = in_process}});
  };
  EXPECT_EQ(study(true).estimators.at(0).failures, 0);
  EXPECT_EQ(message_of([&] { study(false); }), kNoWorker);
}

TEST_F(InProcess, AMonteCarloStudyTellsTheSeedOfTheFirstRunThatFails) {
  scenario.seed = 46;
  scenario.robot.nominal.joint[1].stiffness = 1e-3;
  const std::string message = message_of([&] {
    run_monte_carlo(scenario, first_joints(2), {"kinematics"}, {.runs = 20, .containment = {.in_process = true}});
  });
  EXPECT_TRUE(message.starts_with("seed 46: scenario 'test': joint 2: no stretch of its cable")) << message;
}

TEST_F(InProcess, AComparisonCountsTheMotorsOfEachUpdate) {
  SimulationResult data = simulate(faster(scenario));
  const auto nis = [&] {
    return compare_estimators(scenario.robot, {"ekf"}, data.measured, data.truth, {.containment = {.in_process = true}})
        .judgements[0]
        .nis;
  };
  EXPECT_EQ(nis().readings, 2);
  for (std::size_t i = 1; i < data.measured.size(); i += 2)
    data.measured.motor_position[0][i] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NEAR(nis().readings, 2 / (1.0 / 2 + 1.0 / 1), 0.01);
}

TEST_F(InProcess, ASweepNeedsNoWorker) {
  Sweep sweep;
  sweep.scenario = scenario;
  sweep.model = scenario.robot;
  sweep.grid.name = sweep.grid.id = "in process";
  sweep.grid.axes = {{.parameters = {"joint2.cable.stiffness"}, .is_factor = true, .unit = "", .values = {1}}};
  sweep.grid.estimators = {"kinematics"};
  sweep.grid.units = joint_units(sweep.model);
  const fs::path folder = fs::temp_directory_path() / ("halyard_in_process_" + std::to_string(::getpid()));
  run_sweep(sweep, folder, {.containment = {.in_process = true}});
  const SweepCell cell = StoredCells({folder}, sweep.grid).read(0);
  fs::remove_all(folder);
  EXPECT_EQ(cell.results.at(0).failure, "");
  EXPECT_EQ(message_of([&] { run_sweep(sweep, folder, {}); }), kNoWorker);
}

TEST_F(InProcess, APointOfASweepThatCannotBeSimulatedIsAFailureOfItsEstimators) {
  Sweep sweep;
  sweep.scenario = scenario;
  sweep.scenario.robot.nominal.joint[1].stiffness = 1e-3;
  sweep.model = scenario.robot;
  sweep.grid.estimators = {"kinematics", "ekf"};
  sweep.grid.measures = parse_measures("errors");
  sweep.grid.units = joint_units(sweep.model);
  const SweepCell cell = run_point(sweep, 0, {.in_process = true});
  ASSERT_EQ(cell.results.size(), 2u);
  for (const SweepCell::Result& result : cell.results)
    EXPECT_TRUE(result.failure.starts_with("simulation: scenario 'test': joint 2: no stretch of its cable"))
        << result.failure;
}

TEST_F(InProcess, TheEvaluationOfADiagnosisNeedsNoWorker) {
  Diagnosis nothing_found;
  nothing_found.given = nothing_found.revised = scenario.robot;
  nothing_found.details = std::make_shared<DiagnosisDetails>();
  const Log log = log_of(2);  // diagnose() needs 1.5 s
  expect_runs(evaluate_diagnosis(scenario.robot, nothing_found, {log}, log, {}, {.in_process = true}).estimators);
}

TEST_F(InProcess, AStudyOfAnIdentificationNeedsNoWorker) {
  const Log log = log_of(3.1);  // identify() needs 3 s
  expect_runs(study_identification(scenario.robot, {log}, log, {"joint2.coupling.joint1"}, {}, {.in_process = true})
                  .estimators);
}

TEST_F(InProcess, EachModelHasItsOwnZerosOnAHoldOut) {
  ArmModel revised = scenario.robot;
  for (int k = 0; k < revised.n(); ++k) revised.nominal.joint[k].motor_zero_known = false;
  ArmModel given = revised;
  given.nominal.joint[0].capstan_radius *= 1.05;
  Log by_given = log_of(1), by_revised = by_given;
  home_encoders(by_given, given);
  home_encoders(by_revised, revised);
  const auto rms = [&](const Log& log) {
    return errors_of("kinematics", revised, {{&log, 0}}, {.in_process = true}).rms.at(0);
  };
  EXPECT_NE(by_given.motor_position[0], by_revised.motor_position[0]);
  EXPECT_NEAR(rms(by_given), rms(by_revised), 1e-9);
}

TEST_F(InProcess, TheInnovationsOfAHoldOutCountFromItsStart) {
  const Log log = log_of(1);
  const EstimatorErrors errors = errors_of("ekf", scenario.robot, {{&log, 0.7}}, {.in_process = true});
  double sum = 0, count = 0;
  for (const auto& motor : errors.innovation)
    for (const double white : motor) sum += white * white, count += 1;
  EXPECT_NEAR(errors.mean_nis, sum / count, 1e-9 * errors.mean_nis);  // rounding of the sums
}

}  // namespace
}  // namespace halyard
