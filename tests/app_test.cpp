// Every command end to end: the built program on short runs of the RAVEN-II.
#include <gtest/gtest.h>
#include <pty.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/program_run.h"

namespace halyard::testing_program {
namespace {

using nlohmann::json;

const std::vector<std::string> kLogColumns = {
    "time",             "motor_torque_1",   "motor_torque_2",   "motor_torque_3",   "motor_position_1",
    "motor_position_2", "motor_position_3", "joint_position_1", "joint_position_2", "joint_position_3"};

class App : public ProgramTest {
 protected:
  /// log.csv and log.truth.csv of 1 s of experiment A.
  void simulate_log() const {
    write_short_scenario("experiment_a.xml");
    done({"simulate", "experiment_a.xml", "--out", "log.csv"});
  }

  std::string estimate(const std::string& estimator, const std::string& data, const std::string& out,
                       std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"estimate", "--model", "raven2.xml", "--estimator", estimator, "--data",
                                          data,       "--out",   out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return done(arguments);
  }

  /// Writes a CSV table again with the columns that `keep` names, each cell through `change`.
  template <class Change>
  void rewrite(const std::string& from, const std::string& to, const std::vector<std::string>& keep,
               const std::vector<std::string>& names, const Change& change) const {
    const CsvFile table(path(from));
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
    text += "\n";
    for (const auto& row : table.rows) {
      std::string line;
      for (const std::string& name : keep) {
        if (!line.empty()) line += ',';
        line += change(name, row.at(table.index(name)));
      }
      text += line + "\n";
    }
    write_text(path(to), text);
  }
};

std::string as_is(const std::string&, const std::string& cell) { return cell; }

TEST_F(App, SimulateWritesALogAndItsGroundTruth) {
  write_short_scenario("experiment_a.xml");
  const std::string printed = done({"simulate", "experiment_a.xml", "--out", "run/log.csv"});
  EXPECT_TRUE(contains(printed, "\"A: high tension\": 1001 samples, 1 s, 3 joints")) << printed;

  const CsvFile log(path("run/log.csv")), truth(path("run/log.truth.csv"));
  EXPECT_EQ(log.header, kLogColumns);
  std::vector<std::string> truth_columns = kLogColumns;
  truth_columns.insert(truth_columns.end(), {"joint_velocity_1", "joint_velocity_2", "joint_velocity_3"});
  EXPECT_EQ(truth.header, truth_columns);
  ASSERT_EQ(log.rows.size(), 1001u);
  EXPECT_EQ(log.column("time"), truth.column("time"));

  const double count = 2 * M_PI / 80000;   // rad of joint 1's encoder
  const std::vector<double> measured = log.column("joint_position_1"), exact = truth.column("joint_position_1");
  for (std::size_t i = 0; i < measured.size(); ++i) {
    // Rounded to the nearest count; 1e-8 for 9 printed digits.
    EXPECT_LE(std::abs(measured[i] - exact[i]), count / 2 + 1e-8);
  }
  EXPECT_NE(measured, exact);
}

TEST_F(App, TheSameSimulationGivesTheSameBytes) {
  write_short_scenario("experiment_c.xml", "0.3");
  done({"simulate", "experiment_c.xml", "--out", "1/log.csv"});
  done({"simulate", "experiment_c.xml", "--out", "2/log.csv"});
  EXPECT_TRUE(files_in(path("1")) == files_in(path("2")));
  EXPECT_EQ(files_in(path("1")).size(), 2u);
}

TEST_F(App, EstimateWritesPositionVelocityAndTheirStandardDeviation) {
  simulate_log();
  for (const std::string estimator : {"kinematics", "ekf", "sr_ukf"}) {
    estimate(estimator, "log.csv", estimator + ".csv");
    const CsvFile estimates(path(estimator + ".csv"));
    EXPECT_EQ(estimates.header,
              (std::vector<std::string>{"time", "joint_position_1", "joint_position_2", "joint_position_3",
                                        "joint_velocity_1", "joint_velocity_2", "joint_velocity_3",
                                        "joint_position_std_1", "joint_position_std_2", "joint_position_std_3"}));
    EXPECT_EQ(estimates.rows.size(), 1001u);
  }
  // Kinematics takes cables as rigid and claims no standard deviation; the filter has one.
  EXPECT_EQ(CsvFile(path("kinematics.csv")).number(1000, "joint_position_std_2"), 0);
  EXPECT_GT(CsvFile(path("sr_ukf.csv")).number(1000, "joint_position_std_2"), 0);
}

TEST_F(App, EstimateWritesWhatElseIsEstimatedAndWhatLaterSamplesSayOfEarlierOnes) {
  simulate_log();
  estimate((fs::path(HALYARD_BROKEN_PLUGINS) / "looks_back.so").string(), "log.csv", "est.csv");
  const CsvFile log(path("log.csv")), estimates(path("est.csv"));
  EXPECT_EQ(estimates.header.size(), 16u);
  EXPECT_EQ(estimates.header[10], "twice_1");
  const std::string motor = "motor_position_2", joint = "joint_position_2";
  EXPECT_NEAR(estimates.number(700, joint), 0.5 * (log.number(700, motor) + log.number(701, motor)), 1e-8);
  EXPECT_NEAR(estimates.number(700, "twice_2"), 2 * estimates.number(700, joint), 1e-7);
  const std::size_t last = estimates.rows.size() - 1;
  EXPECT_NEAR(estimates.number(last, joint), log.number(last, motor), 1e-8);
  EXPECT_EQ(estimates.rows[700][13], "");   // none_1

  const RunResult nowhere = run({"estimate", "--model", "raven2.xml", "--estimator",
                           (fs::path(HALYARD_BROKEN_PLUGINS) / "revises_nowhere.so").string(), "--data", "log.csv",
                           "--out", "none.csv"});
  EXPECT_EQ(nowhere.exit_code, 1);
  EXPECT_TRUE(contains(nowhere.err, "revises its estimate of 1000000 s, where no sample is")) << nowhere.err;
}

TEST_F(App, EstimatePrintsTheRmsThatItsFileHasAfterHalfASecond) {
  simulate_log();
  const std::string printed = estimate("kinematics", "log.csv", "est.csv");
  const CsvFile log(path("log.csv")), estimates(path("est.csv"));
  for (int k = 1; k <= 3; ++k) {
    const std::string column = "joint_position_" + std::to_string(k);
    const std::vector<double> measured = log.column(column), estimated = estimates.column(column);
    double sum = 0;
    int n = 0;
    for (std::size_t i = 500; i < measured.size(); ++i, ++n) sum += std::pow(estimated[i] - measured[i], 2);
    const double rms = std::sqrt(sum / n);

    const std::string begin = "joint " + std::to_string(k) + " position error after 0.5 s: RMS ";
    const std::size_t at = printed.find(begin);
    ASSERT_NE(at, printed.npos) << printed;
    // Positions near 1 with 9 digits: 1e-8 of rounding in each difference; 6 printed digits of the RMS.
    EXPECT_NEAR(std::stod(printed.substr(at + begin.size())), rms, 1e-8 + 1e-6 * rms);
  }
}

TEST_F(App, EstimatesComeFromMotorSignalsAlone) {
  simulate_log();
  rewrite("log.csv", "motors.csv", {kLogColumns.begin(), kLogColumns.begin() + 7},
          {kLogColumns.begin(), kLogColumns.begin() + 7}, as_is);
  estimate("sr_ukf", "log.csv", "with/est.csv");
  const std::string printed = estimate("sr_ukf", "motors.csv", "without/est.csv");
  EXPECT_TRUE(files_in(path("with")) == files_in(path("without")));
  EXPECT_FALSE(contains(printed, "position error")) << printed;
}

TEST_F(App, EstimateReadsAForeignLogByColumnEntriesOverThoseOfTheModel) {
  simulate_log();
  // Torques in mN m with the other sign, joint 1's motor in degrees, and a column that nobody asked for.
  const auto foreign = [](const std::string& name, const std::string& cell) {
    char text[40];
    if (name.starts_with("motor_torque")) {
      std::snprintf(text, sizeof text, "%.12g", -1000 * std::stod(cell));
      return std::string(text);
    }
    if (name != "motor_position_1") return cell;
    std::snprintf(text, sizeof text, "%.14g", 180 / M_PI * std::stod(cell));
    return std::string(text);
  };
  std::vector<std::string> keep(kLogColumns.begin(), kLogColumns.begin() + 7);
  keep.push_back("time");
  rewrite("log.csv", "foreign.csv", keep,
          {"t", "tau a", "tau b", "tau c", "shoulder", "motor_position_2", "motor_position_3", "battery"}, foreign);
  // The model's map has joint 1's motor in the wrong unit: the command line wins.
  write_text(path("raven2.xml"),
             replaced(text_of(path("raven2.xml")), "</arm>",
                      "<columns><column name=\"time\" from=\"t\"/><column name=\"motor_position_1\" "
                      "from=\"shoulder\"/></columns></arm>"));
  const std::string printed =
      estimate("sr_ukf", "foreign.csv", "foreign_est.csv",
               {"--column", "motor_torque_1=tau a,unit=mN.m,sign=-1", "--column", "motor_torque_2=tau b,scale=-0.001",
                "--column=motor_torque_3=tau c,unit=mN.m,sign=-1", "--column", "motor_position_1=shoulder,unit=deg"});
  EXPECT_TRUE(contains(printed, "note: foreign.csv: columns that are not used: battery\n")) << printed;

  fs::copy_file(example("raven2.xml"), path("raven2.xml"), fs::copy_options::overwrite_existing);
  estimate("sr_ukf", "log.csv", "est.csv");
  const CsvFile expected(path("est.csv")), mapped(path("foreign_est.csv"));
  for (const char* column : {"joint_position_1", "joint_position_2", "joint_position_3"}) {
    for (std::size_t i = 0; i < expected.rows.size(); i += 100) {
      // Turned to and fro with 12 digits, the last of 9 printed digits may round the other way: 1e-8, and half of it
      // for the decimals themselves.
      EXPECT_NEAR(mapped.number(i, column), expected.number(i, column), 1.5e-8) << column << " at row " << i;
    }
  }
}

TEST_F(App, MeasuredLoadsReachTheEstimatorsOnlyWhenAsked) {
  simulate_log();
  std::vector<std::string> names(kLogColumns.begin(), kLogColumns.begin() + 7), keep = names;
  names.push_back("joint_torque_2");
  keep.push_back("time");   // a load that grows to 1 N m
  rewrite("log.csv", "loaded.csv", keep, names, as_is);
  estimate("sr_ukf", "log.csv", "est.csv");
  estimate("sr_ukf", "loaded.csv", "unasked.csv");
  estimate("sr_ukf", "loaded.csv", "asked.csv", {"--use-joint-torque"});
  EXPECT_EQ(text_of(path("unasked.csv")), text_of(path("est.csv")));
  EXPECT_NE(text_of(path("asked.csv")), text_of(path("est.csv")));
}

TEST_F(App, ALogThatStartsWithoutAllMotorPositionsIsEstimatedFromTheFirstCompleteRow) {
  write_text(path("gap.csv"),
             "time,motor_torque_1,motor_torque_2,motor_torque_3,motor_position_1,motor_position_2,motor_position_3\n"
             "0,0,0,0,107,,904\n0.001,,0,0,107,204,904\n0.002,0,0,0,107,,904\n0.5,0,0,0,107,204,904\n");
  fs::copy(example("raven2.xml"), path("raven2.xml"));
  estimate("kinematics", "gap.csv", "est.csv");
  const std::vector<std::string> lines = lines_of(text_of(path("est.csv")));
  ASSERT_EQ(lines.size(), 6u);   // comment, header, four rows
  EXPECT_EQ(lines[2], "0,,,,,,,,,");
  EXPECT_TRUE(lines[3].starts_with("0.001,0.7")) << lines[3];
  EXPECT_TRUE(lines[5].starts_with("0.5,0.7")) << lines[5];
}

TEST_F(App, CompareJudgesEstimatorsByTheTruthOfASimulatedScenario) {
  write_short_scenario("experiment_a.xml", "1.5");
  const std::string printed = done(
      {"compare", "experiment_a.xml", "--model", "raven2.xml", "--estimators", "kinematics,sr_ukf", "--out", "cmp"});
  EXPECT_TRUE(contains(printed, "us a step")) << printed;
  const auto files = files_in(path("cmp"));
  ASSERT_EQ(files.size(), 3u);
  const json result = json::parse(files.at("comparison.json"));
  EXPECT_EQ(result.at("truth"), "truth of the simulation");
  const json &kinematics = result.at("estimators").at(0), &sr_ukf = result.at("estimators").at(1);
  const CsvFile table(path("cmp/comparison.csv"));
  for (int k = 0; k < 3; ++k) {
    const json &naive = kinematics.at("joints").at(k), &filter = sr_ukf.at("joints").at(k);
    EXPECT_EQ(filter.at("samples"), 1001);   // 0.5 .. 1.5 s
    const double gain =
        1 - filter.at("mean_absolute_error").get<double>() / naive.at("mean_absolute_error").get<double>();
    EXPECT_DOUBLE_EQ(filter.at("improvement_over_kinematics").get<double>(), gain);
    // The model is right, the cables stretch: a filter that knows it must gain most of kinematics' error.
    EXPECT_GT(gain, 0.5) << "joint " << k + 1;
    const double mean = filter.at("mean_absolute_error"), rms = filter.at("rms_error"), peak = filter.at("peak_error");
    EXPECT_TRUE(std::abs(filter.at("bias").get<double>()) <= mean && mean <= rms && rms <= peak);
    const std::size_t row = table.row_with({{"estimator", "sr_ukf"}, {"joint", std::to_string(k + 1)}});
    EXPECT_NEAR(table.number(row, "rms_error"), rms, 1e-8 * rms);   // 9 digits
  }
  const std::string& report = files.at("report.html");
  EXPECT_TRUE(contains(report, "Eq. 18"));
  EXPECT_TRUE(contains(report, "Joint 3: errors"));
}

TEST_F(App, CompareSaysWhichIsBetterAndWhetherEachKnowsHowFarOffItIs) {
  write_short_scenario("experiment_a.xml", "1.5");
  const std::vector<std::string> ask = {"compare", "experiment_a.xml", "--estimators", "kinematics,ekf", "--runs", "3", "--noise"};
  const auto run = [&](const std::string& noise) {
    std::vector<std::string> arguments = ask;
    for (const std::string& more : {noise, std::string("--out"), "noise_" + noise}) arguments.push_back(more);
    done(arguments);
    return json::parse(text_of(path("noise_" + noise + "/comparison.json")));
  };
  const json right = run("1"), ten = run("10");
  for (int k = 0; k < 3; ++k) {
    const json& pair = right.at("paired").at(k);
    EXPECT_EQ(pair.at("verdict"), "better") << "joint " << k + 1;
    EXPECT_LT(pair.at("ci95").at(1), 0.5);
    EXPECT_EQ(right.at("estimators").at(0).at("joints").at(k).at("nees").at("verdict"), "none");
    const json& of_ten = ten.at("monte_carlo").at("estimators").at(1).at("joints").at(k);
    EXPECT_EQ(of_ten.at("nees").at("verdict"), "too sure") << "joint " << k + 1;
    EXPECT_LT(of_ten.at("instants_in_band"), 0.5);
  }
  const json& ekf = right.at("monte_carlo").at("estimators").at(1);
  EXPECT_EQ(ekf.at("failures"), 0);
  EXPECT_NEAR(ekf.at("nis").at("mean"), 1, 0.1);
  EXPECT_GT(ten.at("monte_carlo").at("estimators").at(1).at("nis").at("mean"), 10);
  EXPECT_TRUE(contains(text_of(path("noise_1/report.html")), "3 runs with seeds of their own"));
}

TEST_F(App, TheSameComparisonGivesTheSameBytes) {
  write_short_scenario("experiment_a.xml", "0.6");
  for (const char* out : {"1", "2"}) {
    done({"compare", "experiment_a.xml", "--model", "raven2.xml", "--estimators", "kinematics,ekf,sr_ukf", "--runs", "2",
          "--out", out});
  }
  EXPECT_TRUE(files_in(path("1")) == files_in(path("2")));
}

TEST_F(App, CompareTakesALogAndAPluginByItsPath) {
  simulate_log();
  fs::copy(fs::path(HALYARD_PROGRAM).parent_path() / "plugins/kinematics.so", path("mine.so"));
  done({"compare", "log.csv", "--model", "raven2.xml", "--estimators", "kinematics,./mine.so", "--out", "cmp"});
  const json result = json::parse(text_of(path("cmp/comparison.json")));
  EXPECT_EQ(result.at("truth"), "joint sensors");
  const json &named = result.at("estimators").at(0), &loaded = result.at("estimators").at(1);
  EXPECT_EQ(loaded.at("estimator"), "./mine.so");
  EXPECT_EQ(loaded.at("joints").at(1).at("rms_error"), named.at("joints").at(1).at("rms_error"));
}

TEST_F(App, CompareOfALogWithoutJointSensorsSaysThatThereIsNothingToJudgeBy) {
  simulate_log();
  const std::vector<std::string> motors(kLogColumns.begin(), kLogColumns.begin() + 7);
  rewrite("log.csv", "motors.csv", motors, motors, as_is);
  done({"compare", "motors.csv", "--model", "raven2.xml", "--estimators", "kinematics", "--out", "cmp"});
  const json result = json::parse(text_of(path("cmp/comparison.json")));
  EXPECT_TRUE(result.at("truth").is_null());
  EXPECT_TRUE(result.at("estimators").at(0).at("joints").at(0).at("rms_error").is_null());
  EXPECT_TRUE(contains(text_of(path("cmp/report.html")), "nothing to judge them by"));
}

TEST_F(App, CheckTellsWhatAFileIs) {
  EXPECT_TRUE(contains(done({"check", example("raven2.xml")}), "valid model \"RAVEN-II\""));
  const std::string scenario = done({"check", example("experiment_c.xml")});
  EXPECT_TRUE(contains(scenario, "valid scenario \"C: payload\"")) << scenario;
  EXPECT_TRUE(contains(scenario, "effects: payload")) << scenario;
  EXPECT_TRUE(contains(done({"check", example("tension_sweep.xml")}), "14 points"));
}

TEST_F(App, CheckAcceptsEveryExample) {
  int examples = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(HALYARD_SOURCE_DIR) / "examples/raven2")) {
    if (entry.path().extension() != ".xml") continue;
    EXPECT_TRUE(contains(done({"check", entry.path().string()}), ": valid ")) << entry.path();
    ++examples;
  }
  EXPECT_GE(examples, 7);
}

TEST_F(App, PluginsListsTheBuiltInEstimators) {
  const std::string printed = done({"plugins"});
  for (const char* name : {"kinematics ", "disturbance_sr_ukf ", "ekf ", "sr_ukf "})
    EXPECT_TRUE(contains("\n" + printed, std::string("\n") + name));
}

TEST_F(App, HelpAndVersionGoToStdout) {
  const std::string help = done({"--help"});
  for (const char* command : {"simulate", "estimate", "compare", "sweep", "merge", "plugins", "check"}) {
    EXPECT_TRUE(contains(help, command));
  }
  EXPECT_TRUE(contains(done({"sweep", "--help"}), "--shard"));
  EXPECT_TRUE(done({"--version"}).starts_with("halyard "));
}

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
};

TEST_F(Sweep, GivesTheSameBytesForAnyNumberOfJobsAndAnyShards) {
  done({"sweep", "sweep.xml", "--out", "one", "--jobs", "1"});
  done({"sweep", "sweep.xml", "--out", "two", "--jobs", "3"});
  done({"sweep", "sweep.xml", "--out", "part1", "--shard", "1/2"});
  EXPECT_FALSE(fs::exists(path("part1/sweep.csv")));
  done({"sweep", "sweep.xml", "--out", "part2", "--shard", "2/2"});
  done({"merge", "part1", "part2", "--out", "merged"});
  const auto one = files_in(path("one"));
  EXPECT_EQ(one.size(), 9u);   // sweep.json, six cells, table, report
  EXPECT_TRUE(files_in(path("two")) == one);
  EXPECT_TRUE(files_in(path("merged")) == one);
}

TEST_F(Sweep, KnowsTheSameErrorsAsAComparisonOfTheSamePoint) {
  done({"sweep", "sweep.xml", "--out", "out"});
  write_text(path("experiment_a.xml"),
             replaced(text_of(path("experiment_a.xml")), "duration=\"1\"", "duration=\"0.6\""));
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

TEST_F(Sweep, ResumesWithoutComputingFinishedCellsAgain) {
  done({"sweep", "sweep.xml", "--out", "out"});
  const auto whole = files_in(path("out"));
  // A mark that only a cell which is kept still has.
  const fs::path kept = path("out/cells/000001.json"), lost = path("out/cells/000004.json");
  write_text(kept, text_of(kept) + "\n\n");
  fs::remove(lost);
  fs::remove(path("out/sweep.csv"));
  done({"sweep", "sweep.xml", "--out", "out", "--resume"});
  EXPECT_TRUE(text_of(kept).ends_with("\n\n\n"));
  EXPECT_EQ(text_of(lost), whole.at("cells/000004.json"));
  EXPECT_EQ(text_of(path("out/sweep.csv")), whole.at("sweep.csv"));
  // Without --resume all is computed anew.
  done({"sweep", "sweep.xml", "--out", "out"});
  EXPECT_TRUE(files_in(path("out")) == whole);
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
}

/// The folder raven2 with the experiments and a robot that has one of the likely robot's effects, at joint 2.
class Experiments : public App {
 protected:
  void SetUp() override {
    App::SetUp();
    for (const char* name : {"experiment_a.xml", "experiment_b.xml", "experiment_c.xml", "raven2.xml"})
      write_text(path(std::string("raven2/") + name), text_of(example(name)));
    write_text(path("raven2/raven2_likely.xml"),
               replaced(text_of(example("raven2.xml")), "</arm>",
                        "<effects><effect name=\"stiffness\" joint=\"2\" stiffness_ratio=\"0.5\"/></effects></arm>"));
  }
};

TEST_F(Experiments, StandBesideThePublishedErrors) {
  const std::string printed =
      done({"experiments", "--examples", ".", "--duration", "0.7", "--no-effect-study", "--calibrated",
            "raven2/raven2.xml", "--out", "out"});
  EXPECT_TRUE(contains(printed, "sr_ukf")) << printed;
  EXPECT_TRUE(contains(printed, "joint 1 < joint 2 < joint 3")) << printed;
  const auto files = files_in(path("out"));
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(lines_of(files.at("experiments.csv")).size(), 1u + 3 * 5 * 3);
  const json result = json::parse(files.at("experiments.json"));
  const json& published = result.at("measured_on_the_robot").at(0).at("mean_absolute_error");
  EXPECT_NEAR(published.at(1).get<double>(), 2.6383 * M_PI / 180, 1e-12);   // rounding
  EXPECT_DOUBLE_EQ(published.at(2).get<double>(), 2.507e-3);
  double sum = 0;
  for (const json& e : result.at("experiments")) {
    sum += e.at("estimators").at(0).at("joints").at(1).at("mean_absolute_error").get<double>();
  }
  EXPECT_NEAR(result.at("mean_of_experiments").at(0).at("mean_absolute_error").at(1).get<double>(), sum / 3, 1e-15);
  EXPECT_TRUE(contains(files.at("report.html"), "2.638"));
  EXPECT_TRUE(contains(files.at("report.html"), "What the numbers mean"));
}

TEST_F(Experiments, RunACalibratedModelBesideTheGivenOne) {
  // The robot itself: the filter then knows the stretch, which kinematics leaves out whatever the stiffness.
  done({"experiments", "--examples", ".", "--duration", "1.5", "--no-effect-study", "--calibrated",
        "raven2/raven2_likely.xml", "--out", "out"});
  const json means = json::parse(text_of(path("out/experiments.json"))).at("mean_of_experiments");
  std::map<std::string, double> error;
  for (const json& row : means)
    error[row.at("estimator").get<std::string>()] = row.at("mean_absolute_error").at(1).get<double>();
  ASSERT_EQ(error.size(), 5u) << means.dump(2);
  EXPECT_LT(error.at("sr_ukf, calibrated"), 0.1 * error.at("sr_ukf"));
  EXPECT_EQ(error.at("kinematics, calibrated"), error.at("kinematics"));
}

TEST_F(Experiments, TellWhichEffectMakesTheError) {
  done({"experiments", "--examples", ".", "--duration", "0.6", "--calibrated", "raven2/raven2.xml", "--out", "out"});
  const CsvFile table(path("out/effects.csv"));
  const auto error = [&](const char* effects, const char* estimator) {
    return table.number(table.row_with({{"effects", effects}, {"estimator", estimator}, {"joint", "2"}}),
                        "mean_absolute_error");
  };
  // None, two alone, all, all but each of two; two estimators, three joints.
  EXPECT_EQ(table.rows.size(), 6u * 2 * 3);
  // The payload is there in C alone, the cable in all three. What is switched off leaves what the other makes alone.
  EXPECT_EQ(error("all but stiffness", "kinematics"), error("payload alone", "kinematics"));
  EXPECT_EQ(error("all but payload", "sr_ukf"), error("stiffness alone", "sr_ukf"));
  EXPECT_GT(error("stiffness alone", "sr_ukf"), 10 * error("none", "sr_ukf"));
  // With all, as the experiments themselves.
  const json means = json::parse(text_of(path("out/experiments.json"))).at("mean_of_experiments");
  const double of_experiments = means.at(0).at("mean_absolute_error").at(1).get<double>();
  EXPECT_NEAR(error("all", "kinematics"), of_experiments, 1e-8 * of_experiments);   // 9 digits of CSV
}

TEST_F(App, ProgressIsShownOnATerminalAndWipedAndNowhereElse) {
  write_short_scenario("experiment_a.xml", "4");
  int terminal = -1;
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    ::execl(HALYARD_PROGRAM, "halyard", "simulate", path("experiment_a.xml").c_str(), "--out", path("log.csv").c_str(),
            static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ASSERT_GT(child, 0);
  std::string shown;
  char buffer[4096];
  for (ssize_t n; (n = ::read(terminal, buffer, sizeof buffer)) > 0;) shown.append(buffer, std::size_t(n));
  ::close(terminal);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  // Fraction, rate, time left; the line is wiped before the summary.
  EXPECT_TRUE(contains(shown, " %   ") && contains(shown, " s/s   ") && contains(shown, " s left")) << shown;
  EXPECT_TRUE(contains(shown, "\r\033[Kscenario \"A: high tension\"")) << shown;
  // done() sees to it that a pipe gets nothing.
  done({"simulate", "experiment_a.xml", "--out", "log.csv"});
}

}  // namespace
}  // namespace halyard::testing_program
