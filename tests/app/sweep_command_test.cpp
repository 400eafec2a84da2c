// halyard sweep and merge, end to end on short runs of the RAVEN-II.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/app_runs.h"
#include "tests/support/short_arm.h"

namespace halyard::testing_program {
namespace {

class Sweep : public App {
 protected:
  void SetUp() override {
    App::SetUp();
    write_short_scenario("experiment_a.xml");
    // Joint 2's cable softer than, as and stiffer than believed; without and with backlash.
    write_text(
        path("sweep.xml"),
        "<sweep name=\"test\" scenario=\"experiment_a.xml\" estimators=\"kinematics,sr_ukf\" duration=\"0.6\">"
        "<axis parameter=\"joint2.cable.stiffness\" factor=\"true\" from=\"0.5\" to=\"2\" steps=\"3\" scale=\"log\" "
        "applies_to=\"robot\"/>"
        "<axis parameter=\"joint2.effect.backlash.half_gap\" values=\"0 2e-4\" applies_to=\"robot\"/></sweep>");
  }

  /// A program that stands for one of Slurm.
  void write_program(const std::string& name, const std::string& commands) {
    write_text(path("bin/" + name), "#!/bin/sh\n" + commands + "\n");
    fs::permissions(path("bin/" + name), fs::perms::owner_all);
  }
  RunResult run_with_slurm(const std::vector<std::string>& command) const {
    return run(command, "PATH='" + path("bin").string() + "':$PATH; export PATH;");
  }

  const std::vector<std::string> submit_ = {"sweep", "sweep.xml", "--out", "out", "--slurm", "--nodes", "2"};
};

TEST_F(Sweep, GivesTheSameBytesForAnyNumberOfJobsAndAnyShards) {
  done({"sweep", "sweep.xml", "--out", "one", "--jobs", "1"});
  done({"sweep", "sweep.xml", "--out", "two", "--jobs", "3"});
  done({"sweep", "sweep.xml", "--out", "part1", "--shard", "1/2"});
  EXPECT_FALSE(fs::exists(path("part1/sweep.csv")));
  done({"sweep", "sweep.xml", "--out", "part2", "--shard", "2/2"});
  done({"merge", "part1", "part2", "--out", "merged"});
  const auto one = files_in(path("one"));
  EXPECT_EQ(one.size(), 6u);  // sweep.json, cells, table, report, two pictures
  EXPECT_TRUE(files_in(path("two")) == one);
  EXPECT_TRUE(files_in(path("merged")) == one);
}

TEST_F(Sweep, KnowsTheSameErrorsAsAComparisonOfTheSamePoint) {
  done({"sweep", "sweep.xml", "--out", "out"});
  // As the sweep runs it: shorter, and on the own chain.
  write_text(path("experiment_a.xml"),
             replaced(text_of(path("experiment_a.xml")), "duration=\"1\"", "duration=\"0.6\" engine=\"halyard\""));
  done({"compare", "experiment_a.xml", "--model", "raven2.xml", "--estimators", "kinematics,sr_ukf", "--out", "cmp"});
  const CsvFile sweep(path("out/sweep.csv")), comparison(path("cmp/comparison.csv"));
  EXPECT_EQ(sweep.rows.size(), 3u * 2 * 2 * 3);
  const std::string stiffness = "joint2.cable.stiffness (factor)", gap = "joint2.effect.backlash.half_gap";
  const auto error = [&](const std::string& factor, const std::string& half_gap) {
    return sweep.number(sweep.row_with({{stiffness, factor}, {gap, half_gap}, {"estimator", "sr_ukf"}, {"joint", "2"}}),
                        "mean_absolute_error");
  };
  // A factor of 1 and no gap is the scenario itself.
  EXPECT_DOUBLE_EQ(error("1", "0"), comparison.number(comparison.row_with({{"estimator", "sr_ukf"}, {"joint", "2"}}),
                                                      "mean_absolute_error"));
  // The filter believes the model: what the robot has beyond it costs.
  EXPECT_GT(error("0.5", "0"), 2 * error("1", "0"));
  EXPECT_GT(error("2", "0"), 2 * error("1", "0"));
  EXPECT_GT(error("1", "0.0002"), 2 * error("1", "0"));
}

TEST_F(Sweep, MeasuresWhatItsFileAsksFor) {
  write_text(path("nees.xml"),
             replaced(text_of(path("sweep.xml")), " duration=", " measures=\"nees,counts,time\" duration="));
  done({"sweep", "nees.xml", "--out", "one", "--jobs", "1"});
  done({"sweep", "nees.xml", "--out", "two"});
  const CsvFile table(path("one/sweep.csv")), times(path("one/time.csv"));
  EXPECT_FALSE(contains(text_of(path("one/sweep.csv")), "error")) << "not asked for";
  EXPECT_EQ(times.rows.size(), 3u * 2 * 2);
  EXPECT_GT(times.number(times.row_with({{"estimator", "sr_ukf"}}), "microseconds_per_step"), 0);
  // All that does not say how long it took is repeatable.
  auto one = files_in(path("one")), two = files_in(path("two"));
  for (auto* files : {&one, &two})
    for (const char* name : {"time.csv", "cells/all.jsonl"}) EXPECT_EQ(files->erase(name), 1u);
  EXPECT_TRUE(one == two);
  EXPECT_TRUE(contains(one.at("report.html"), "mean NEES"));
  EXPECT_FALSE(contains(one.at("report.html"), "mean absolute error"));
  EXPECT_TRUE(contains(one.at("heat_map.svg"), "gated measurements"));
  // As a comparison of the same point has it: a factor of 1 and no gap.
  write_text(path("experiment_a.xml"),
             replaced(text_of(path("experiment_a.xml")), "duration=\"1\"", "duration=\"0.6\" engine=\"halyard\""));
  done({"compare", "experiment_a.xml", "--model", "raven2.xml", "--estimators", "sr_ukf", "--out", "cmp"});
  const auto sr_ukf = nlohmann::json::parse(text_of(path("cmp/comparison.json"))).at("estimators").at(0);
  const std::size_t row = table.row_with({{"point", "2"}, {"estimator", "sr_ukf"}, {"joint", "2"}});
  EXPECT_FLOAT_EQ(table.number(row, "mean_nees"), sr_ukf.at("joints").at(1).at("nees").at("mean"));
  EXPECT_EQ(table.number(row, "steps"), sr_ukf.at("steps"));
}

TEST_F(Sweep, MeasuresDetectionLimits) {
  write_text(path("arm.xml"), model_to_xml(first_joints(1)));
  write_text(path("motion.xml"),
             "<scenario name=\"motion\" model=\"arm.xml\" duration=\"2\"><trajectory joint=\"1\" kind=\"sines\" "
             "center=\"45 deg\"><sine amplitude=\"20 deg\" frequency=\"0.5\"/><sine amplitude=\"6 deg\" "
             "frequency=\"1.3\"/></trajectory></scenario>");
  write_text(path("limits.xml"),
             "<sweep name=\"limits\" scenario=\"motion.xml\" limits=\"backlash,hysteresis\"><axis "
             "parameter=\"joint1.encoders.joint_resolution\" factor=\"true\" values=\"1 100\"/></sweep>");
  EXPECT_TRUE(contains(done({"check", "limits.xml"}), "2 points, limits of backlash, hysteresis"));
  EXPECT_TRUE(contains(done({"sweep", "limits.xml", "--out", "out"}), "2 points, 2 effects"));
  done({"sweep", "limits.xml", "--out", "one", "--jobs", "1"});
  EXPECT_TRUE(files_in(path("out")) == files_in(path("one")));
  const CsvFile table(path("out/sweep.csv"));
  EXPECT_EQ(table.rows.size(), 2u * 2);
  const auto limit = [&](const char* point) {
    return table.number(table.row_with({{"point", point}, {"effect", "backlash"}, {"unit", "m"}}), "detection_limit");
  };
  EXPECT_GT(limit("1"), 3 * limit("0")) << "a coarse encoder hides a small gap";
  EXPECT_TRUE(contains(text_of(path("out/report.html")), "detection limit of backlash, half_gap [m]"));
  EXPECT_TRUE(contains(text_of(path("out/curves.svg")), "detection limit of hysteresis, share"));
}

TEST_F(Sweep, RefusesAPartWithoutANumber) {
  const RunResult result = run({"sweep", "sweep.xml", "--out", "out", "--shard", ""});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(contains(result.err, "--shard '': expected i/n")) << result.err;
  EXPECT_FALSE(fs::exists(path("out")));
}

TEST_F(Sweep, ResumesWithoutComputingFinishedCellsAgain) {
  done({"sweep", "sweep.xml", "--out", "out"});
  const auto whole = files_in(path("out"));
  // Point 1 with a failure that only a cell which is kept still has; without point 4.
  std::string cells;
  for (const std::string& line : lines_of(whole.at("cells/all.jsonl"))) {
    if (line.starts_with("{\"point\":4,")) continue;
    const bool marked = line.starts_with("{\"point\":1,");
    cells += (marked ? replaced(line, "\"failure\":\"\"", "\"failure\":\"mark\"") : line) + "\n";
  }
  write_text(path("out/cells/all.jsonl"), cells);
  EXPECT_TRUE(contains(done({"sweep", "sweep.xml", "--out", "out", "--status"}), "5 of 6 points are done (83.3 %)"));
  fs::remove(path("out/sweep.csv"));
  done({"sweep", "sweep.xml", "--out", "out", "--resume"});
  EXPECT_TRUE(contains(text_of(path("out/sweep.csv")), ",mark,halyard sweep sweep.xml --point 1\n"));
  EXPECT_EQ(text_of(path("out/cells/all.jsonl")),
            replaced(whole.at("cells/all.jsonl"), "{\"point\":1,\"failed\":0,\"results\":[{\"failure\":\"\"",
                     "{\"point\":1,\"failed\":0,\"results\":[{\"failure\":\"mark\""));
  // Without --resume all is computed anew.
  const RunResult anew = run({"sweep", "sweep.xml", "--out", "out"});
  EXPECT_EQ(anew.err, "note: 6 finished points of this sweep will be computed again; --resume keeps them\n");
  EXPECT_TRUE(files_in(path("out")) == whole);
}

TEST_F(Sweep, OfAShardIsNotComputedBesideOlderResultsOfItsPointsInAnotherJournal) {
  done({"sweep", "sweep.xml", "--out", "out", "--shard", "1/2"});
  const auto before = files_in(path("out"));
  const std::vector<std::string> quarter = {"sweep", "sweep.xml", "--out", "out", "--shard", "1/4"};
  const RunResult refused = run(quarter);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(
      refused.err,
      "out/cells/1_of_2.jsonl: holds results of part 1 of 4, such as of point 0, which would count instead of new "
      "ones; keep them with --resume, or remove the folder out\n");
  EXPECT_TRUE(files_in(path("out")) == before);
  done({"sweep", "sweep.xml", "--out", "out", "--shard", "2/2"});  // other points
  const RunResult again = run({"sweep", "sweep.xml", "--out", "out", "--shard", "1/2"});
  EXPECT_EQ(again.exit_code, 0) << "its own journal";
  EXPECT_TRUE(contains(again.err, "3 finished points of this sweep will be computed again")) << again.err;
  done({"merge", "out"});
  EXPECT_TRUE(contains(run(quarter).err, "out/cells/all.jsonl: holds results of part 1 of 4"));
}

TEST_F(Sweep, VariesWhatTheEstimatorsBelieveApartFromTheRobot) {
  const auto errors = [&](const std::string& applies_to) {
    write_text(path("one.xml"),
               "<sweep name=\"one\" scenario=\"experiment_a.xml\" estimators=\"sr_ukf\" duration=\"0.6\"><axis "
               "parameter=\"joint3.cable.stiffness\" values=\"5e3\" applies_to=\"" +
                   applies_to + "\"/></sweep>");
    done({"sweep", "one.xml", "--out", applies_to});
    const CsvFile table(path(applies_to + "/sweep.csv"));
    return table.number(table.row_with({{"joint", "3"}}), "mean_absolute_error");
  };
  // Wrong in the robot alone or in the model alone is wrong; wrong in both is right again.
  const double both = errors("both");
  EXPECT_GT(errors("robot"), 10 * both);
  EXPECT_GT(errors("model"), 10 * both);
}

TEST_F(Sweep, RecordsAnEstimatorThatFailsAndGoesOn) {
  const std::string broken = std::string(HALYARD_BROKEN_PLUGINS) + "/throws_in_update.so";
  write_text(path("plugin.xml"), replaced(text_of(path("sweep.xml")), "kinematics,sr_ukf", "kinematics," + broken));
  const std::string printed = done({"sweep", "plugin.xml", "--out", "out"});
  EXPECT_TRUE(contains(printed, "6 of 12 runs of estimators failed")) << printed;
  const CsvFile table(path("out/sweep.csv"));
  const std::size_t failed = table.row_with({{"estimator", broken}});
  EXPECT_EQ(table.rows[failed].at(table.index("mean_absolute_error")), "");
  EXPECT_NE(table.rows[failed].at(table.index("failure")), "");
  EXPECT_GT(table.number(table.row_with({{"estimator", "kinematics"}}), "mean_absolute_error"), 0);
  EXPECT_TRUE(contains(text_of(path("out/report.html")), "6 of 12 runs of estimators failed"));
  EXPECT_TRUE(contains(done({"sweep", "plugin.xml", "--out", "out", "--status"}), "6 of them with a failure"));
  // The command beside the reason repeats it.
  EXPECT_EQ(table.rows[failed].at(table.index("repeat_with")), "halyard sweep plugin.xml --point 0");
  const RunResult repeated = run({"sweep", "plugin.xml", "--point", "0"});
  EXPECT_EQ(repeated.exit_code, 1);
  EXPECT_TRUE(contains(repeated.out, broken + ": failed: ")) << repeated.out;
  EXPECT_EQ(repeated.err, "halyard sweep: 1 of 2 estimators failed at point 0\n");
}

TEST_F(Sweep, OfShardsInOneFolderIsMergedThere) {
  done({"sweep", "sweep.xml", "--out", "local"});
  done({"sweep", "sweep.xml", "--out", "out", "--shard", "2/2", "--resume"});
  EXPECT_TRUE(contains(done({"sweep", "sweep.xml", "--out", "out", "--status"}),
                       "3 of 6 points are done (50.0 %)\nto continue: halyard sweep sweep.xml --out out --resume\n"));
  done({"sweep", "sweep.xml", "--out", "out", "--shard", "1/2", "--resume"});
  EXPECT_TRUE(contains(done({"sweep", "sweep.xml", "--out", "out", "--status"}), "next: halyard merge out\n"));
  done({"merge", "out"});
  EXPECT_TRUE(files_in(path("out")) == files_in(path("local")));
  EXPECT_TRUE(contains(done({"sweep", "sweep.xml", "--out", "out", "--status"}), "table: out/sweep.csv\n"));
  fs::copy(path("out/cells/all.jsonl"), path("out/cells/1_of_2.jsonl"));  // of a part that ran since
  EXPECT_TRUE(contains(done({"sweep", "sweep.xml", "--out", "out", "--status"}), "next: halyard merge out\n"));
}

TEST_F(Sweep, OfSamplesAndRepeatsHasARowForEachSeed) {
  for (const char* design : {"sobol", "latin_hypercube"}) {
    write_text(
        path("samples.xml"),
        "<sweep name=\"samples\" scenario=\"experiment_a.xml\" estimators=\"kinematics\" duration=\"0.55\" design=\"" +
            std::string(design) +
            "\" samples=\"3\" repeats=\"2\" seed=\"5\">"
            "<axis parameter=\"joint2.cable.stiffness\" factor=\"true\" from=\"0.5\" to=\"2\" scale=\"log\" "
            "applies_to=\"robot\"/>"
            "<axis parameter=\"joint2.effect.backlash.half_gap\" from=\"0\" to=\"2e-4\" "
            "applies_to=\"robot\"/></sweep>");
    const std::string out = std::string("out_") + design;
    EXPECT_TRUE(contains(done({"sweep", "samples.xml", "--out", out}), "6 points, 1 estimators"));
    const CsvFile table(path(out + "/sweep.csv"));
    ASSERT_EQ(table.rows.size(), 6u * 3);
    std::set<double> factors, gaps;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      EXPECT_EQ(table.number(row, "seed"), 5 + (row / 3) % 2);
      factors.insert(table.number(row, "joint2.cable.stiffness (factor)"));
      gaps.insert(table.number(row, "joint2.effect.backlash.half_gap"));
    }
    EXPECT_EQ(factors.size(), 3u);
    EXPECT_EQ(gaps.size(), 3u);
    EXPECT_TRUE(*factors.begin() >= 0.5 && *factors.rbegin() <= 2);
    EXPECT_TRUE(*gaps.begin() >= 0 && *gaps.rbegin() <= 2e-4);
    const std::string report = text_of(path(out + "/report.html"));
    EXPECT_TRUE(contains(report, "averaged over everything else that varies"));
    EXPECT_TRUE(contains(report, "95 % intervals of the means"));
  }
}

TEST_F(Sweep, PrintsTheScriptOfItsJobArray) {
  const std::string script = done({"sweep", "sweep.xml", "--out", "it's 5 %", "--slurm", "--nodes", "3", "--sbatch",
                                   "--time=1:00:00", "--print-script"});
  EXPECT_TRUE(script.starts_with("#!/bin/bash\n")) << script;
  for (const char* part :
       {"# Before sbatch: mkdir -p '", "#SBATCH --array=1-3\n", "#SBATCH --requeue\n", "#SBATCH --time=1:00:00\n",
        "it'\\''s 5 %%/slurm/part_%a.log'\n", "--out 'it'\\''s 5 %' ", "--shard \"$SLURM_ARRAY_TASK_ID/3\" --resume"})
    EXPECT_TRUE(contains(script, part)) << part << " in\n" << script;
  EXPECT_FALSE(fs::exists(path("it's 5 %")));
}

TEST_F(Sweep, TellsWhatABandIsOfOtherParameters) {
  write_text(
      path("grid.xml"),
      "<sweep name=\"grid\" scenario=\"experiment_a.xml\" estimators=\"kinematics\" duration=\"0.52\">"
      "<axis parameter=\"joint2.cable.stiffness\" factor=\"true\" values=\"1 2\"/>"
      "<axis parameter=\"joint1.friction.coulomb\" factor=\"true\" from=\"0.5\" to=\"2\" steps=\"13\"/></sweep>");
  done({"sweep", "grid.xml", "--out", "out"});
  const std::string report = text_of(path("out/report.html"));
  EXPECT_TRUE(contains(report, "The bands reach from the least to the greatest value."));
  EXPECT_FALSE(contains(report, "95 % intervals"));
}

TEST_F(Sweep, IsNotSubmittedTwiceWhereSlurmCannotBeAsked) {
  write_program("sbatch", "echo once >>submitted; echo 17");
  write_program("squeue", "echo 'slurm_load_jobs error: Unable to contact slurm controller' >&2; exit 1");
  EXPECT_EQ(run_with_slurm(submit_).exit_code, 0);
  const RunResult again = run_with_slurm(submit_);
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_TRUE(contains(again.err, "Unable to contact slurm controller")) << again.err;
  const RunResult status = run_with_slurm({"sweep", "sweep.xml", "--out", "out", "--status"});
  EXPECT_EQ(status.exit_code, 0) << status.err;
  EXPECT_FALSE(contains(status.out, "not running")) << status.out;
  EXPECT_EQ(text_of(path("submitted")), "once\n");
}

TEST_F(Sweep, IsSubmittedAgainWithThePartsWhosePointsFailed) {
  for (const char* shard : {"1/2", "2/2"}) done({"sweep", "sweep.xml", "--out", "out", "--shard", shard});
  const fs::path journal = path("out/cells/2_of_2.jsonl");
  const std::string good = "{\"point\":1,\"failed\":0,", failed = "{\"point\":1,\"failed\":1,";
  write_text(journal, replaced(text_of(journal), good, failed));
  write_program("sbatch", "echo 17");
  write_program("squeue", "exit 0");
  EXPECT_TRUE(contains(run_with_slurm(submit_).out,
                       "1 of 2 parts submitted as Slurm job 17\n1 failed point will be tried again\n"));
  EXPECT_TRUE(contains(text_of(path("out/slurm/job.sh")), "#SBATCH --array=2\n"));
  EXPECT_TRUE(contains(run_with_slurm({"sweep", "sweep.xml", "--out", "out", "--status"}).out,
                       "6 of 6 points are done (100.0 %), 1 of them with a failure\n"));
  done({"sweep", "sweep.xml", "--out", "out", "--shard", "2/2", "--resume"});  // as the part does
  EXPECT_TRUE(contains(run_with_slurm(submit_).out, "all 6 points are done\n"));
}

TEST_F(Sweep, AsksTheClusterThatItsJobIsOn) {
  write_program("sbatch", "echo '17;north'");
  write_program("squeue", "case \"$*\" in *--clusters=*north*--job=17*) echo '1 RUNNING n1';; esac");
  EXPECT_TRUE(contains(run_with_slurm(submit_).out, "Slurm job 17 of cluster north"));
  EXPECT_TRUE(contains(run_with_slurm({"sweep", "sweep.xml", "--out", "out", "--status"}).out, "running on n1"));
  const RunResult again = run_with_slurm(submit_);
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_TRUE(contains(again.err, "scancel --clusters=north 17")) << again.err;
}

TEST_F(Sweep, KnowsNothingOfTheJobOfAnotherSweepInItsFolder) {
  done({"sweep", "sweep.xml", "--out", "out", "--shard", "1/2"});
  write_text(path("out/slurm/job.json"), "{\"sweep\": \"another\", \"job\": \"17\", \"parts\": 2}");
  const std::string status = done({"sweep", "sweep.xml", "--out", "out", "--status"});
  EXPECT_FALSE(contains(status, "Slurm job")) << status;
  EXPECT_TRUE(contains(status, "to continue: halyard sweep sweep.xml --out out --resume")) << status;
}

TEST_F(Sweep, IsNotMergedIntoTheFolderOfAnother) {
  done({"sweep", "sweep.xml", "--out", "part"});
  write_text(path("other.xml"), replaced(text_of(path("sweep.xml")), "name=\"test\"", "name=\"other\""));
  done({"sweep", "other.xml", "--out", "merged"});
  const std::string before = text_of(path("merged/sweep.csv"));
  const RunResult result = run({"merge", "part", "--out", "merged"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(contains(result.err, "merged: holds results of another sweep")) << result.err;
  EXPECT_EQ(text_of(path("merged/sweep.csv")), before);
}

TEST_F(Sweep, RecordsAnEstimatorThatCrashesAsItIsMade) {
  const std::string broken = std::string(HALYARD_BROKEN_PLUGINS) + "/crashes_in_create.so";
  write_text(path("plugin.xml"), replaced(text_of(path("sweep.xml")), "kinematics,sr_ukf", "kinematics," + broken));
  EXPECT_TRUE(contains(done({"sweep", "plugin.xml", "--out", "out"}), "6 of 12 runs of estimators failed"));
  EXPECT_EQ(run({"check", "plugin.xml"}).exit_code, 1) << "before nodes are taken for it";
}

TEST_F(Sweep, GivesTheSameBytesFromAnyFolder) {
  fs::create_directories(path("sub"));
  fs::copy(fs::path(HALYARD_BROKEN_PLUGINS) / "crashes_in_update.so", path("sub/mine.so"));
  write_text(path("sub/sweep.xml"), replaced(replaced(text_of(path("sweep.xml")), "kinematics,sr_ukf", "ekf,mine.so"),
                                             "experiment_a", "../experiment_a"));
  done({"sweep", "sub/sweep.xml", "--out", "one"});
  EXPECT_EQ(run({"sweep", "sweep.xml", "--out", "../two"}, "cd sub;").exit_code, 0);
  EXPECT_TRUE(files_in(path("one")) == files_in(path("two")));
  EXPECT_TRUE(contains(text_of(path("one/sweep.csv")), ",estimator mine.so on the simulated log at "));
}

TEST_F(Sweep, RefusesAWrongEstimatorBehindOneThatCrashesAsItIsMade) {
  const std::string broken = std::string(HALYARD_BROKEN_PLUGINS) + "/crashes_in_create.so";
  write_text(path("wrong.xml"), replaced(text_of(path("sweep.xml")), "kinematics,sr_ukf", broken + ",ekff"));
  const RunResult result = run({"sweep", "wrong.xml", "--out", "out"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(contains(result.err, "no estimator is named 'ekff'")) << result.err;
}

TEST_F(Sweep, RefusesAnOptionOfAnEstimatorThatNoModuleIs) {
  const std::string module = std::string(HALYARD_BROKEN_PLUGINS) + "/throws_in_update.so";
  write_text(path("option.xml"), "<sweep name=\"s\" scenario=\"experiment_a.xml\" estimators=\"ekf," + module +
                                     "\" duration=\"0.6\"><axis parameter=\"estimator.efk.torque_noise\" "
                                     "values=\"1e-4 0.1\"/></sweep>");
  const RunResult result = run({"sweep", "option.xml", "--out", "out"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(contains(result.err, "'estimator.efk.torque_noise': the sweep does not run this estimator"))
      << result.err;
}

TEST_F(Sweep, LeavesAModuleThatCrashesAsItIsOpenedToThePointsAlsoWithAnOptionOfAnotherEstimator) {
  const std::string module = std::string(HALYARD_BROKEN_PLUGINS) + "/crashes_in_table.so";
  write_text(path("option.xml"), "<sweep name=\"s\" scenario=\"experiment_a.xml\" estimators=\"ekf," + module +
                                     "\" duration=\"0.6\"><axis parameter=\"estimator.ekf.torque_noise\" "
                                     "values=\"1e-4 0.1\"/></sweep>");
  EXPECT_TRUE(contains(done({"sweep", "option.xml", "--out", "out"}), "2 of 4 runs of estimators failed"));
}

TEST_F(Sweep, IsNotSubmittedWithAnEstimatorThatDoesNotExist) {
  write_text(path("wrong.xml"), replaced(text_of(path("sweep.xml")), "kinematics,sr_ukf", "kinematics,ekff"));
  const RunResult result = run({"sweep", "wrong.xml", "--out", "out", "--slurm", "--nodes", "2"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(contains(result.err, "no estimator is named 'ekff'")) << result.err;
}

}  // namespace
}  // namespace halyard::testing_program
