// halyard estimate, end to end on short runs of the RAVEN-II.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/support/app_runs.h"
#include "tests/support/environment.h"

namespace halyard::testing_program {
namespace {

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
  EXPECT_EQ(estimates.rows[700][13], "");  // none_1

  const RunResult nowhere = run({"estimate", "--model", "raven2.xml", "--estimator",
                                 (fs::path(HALYARD_BROKEN_PLUGINS) / "revises_nowhere.so").string(), "--data",
                                 "log.csv", "--out", "none.csv"});
  EXPECT_EQ(nowhere.exit_code, 1);
  EXPECT_TRUE(contains(nowhere.err, "revises its estimate of 1000000 s, where no sample is")) << nowhere.err;
}

TEST_F(App, EstimateDoesNotReplaceTheModuleOfItsEstimator) {
  simulate_log();
  fs::copy(fs::path(HALYARD_PROGRAM).parent_path() / "plugins/kinematics.so", path("mine.so"));
  const std::string module = text_of(path("mine.so"));
  const RunResult result =
      run({"estimate", "--model", "raven2.xml", "--estimator", "./mine.so", "--data", "log.csv", "--out", "mine.so"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(contains(result.err, "--out 'mine.so': would replace an input of this command")) << result.err;
  EXPECT_TRUE(text_of(path("mine.so")) == module);
}

TEST_F(App, KinematicsNeedsNoTorque) {
  simulate_log();
  estimate("kinematics", "log.csv", "with.csv");
  const auto estimate_without = [&](const std::string& estimator) {
    return run({"estimate", "--model", "raven2.xml", "--estimator", estimator, "--data", "log.csv", "--column",
                "motor_torque_1=", "--column", "motor_torque_2=", "--column", "motor_torque_3=", "--out",
                "without.csv"});
  };
  EXPECT_EQ(estimate_without("kinematics").exit_code, 0);
  EXPECT_EQ(text_of(path("without.csv")), text_of(path("with.csv")));
  EXPECT_EQ(estimate_without("ekf").exit_code, 2);
}

TEST_F(App, EstimatesOfInstructionSetsDifferByRounding) {
  simulate_log();
  estimate("sr_ukf", "log.csv", "widest.csv");
  {
    const Environment generic("HALYARD_INSTRUCTION_SET", "generic");
    estimate("sr_ukf", "log.csv", "generic.csv");
  }
  const CsvFile widest(path("widest.csv")), generic(path("generic.csv"));
  ASSERT_EQ(widest.rows.size(), generic.rows.size());
  // A unit of the last digit that the file has.
  for (std::size_t i = 0; i < widest.rows.size(); ++i)
    EXPECT_NEAR(widest.number(i, "joint_position_2"), generic.number(i, "joint_position_2"), 1.01e-8);
}

TEST_F(App, AnUnknownInstructionSetIsTold) {
  const Environment unknown("HALYARD_INSTRUCTION_SET", "avx1024");
  const RunResult result = run({"--version"});
  EXPECT_EQ(result.exit_code, 2) << result.out;
  EXPECT_EQ(lines_of(result.err).size(), 1u) << result.err;
  EXPECT_TRUE(contains(result.err, "HALYARD_INSTRUCTION_SET is \"avx1024\", expected generic, avx2 or avx512"))
      << result.err;
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

TEST_F(App, EstimateAndCompareWarnOfALogWhoseErrorsWouldBeThoseOfItsColumns) {
  simulate_log();
  const std::vector<std::string> in_degrees = {"--column", "joint_position_2=joint_position_2,scale=57.3"};
  const std::string warning = "warning: log.csv: joint_position_2: ";
  const std::string printed = estimate("kinematics", "log.csv", "est.csv", in_degrees);
  EXPECT_TRUE(contains(printed, warning)) << printed;
  std::vector<std::string> compare = {"compare",      "log.csv",    "--model", "raven2.xml",
                                      "--estimators", "kinematics", "--out",   "warned"};
  compare.insert(compare.end(), in_degrees.begin(), in_degrees.end());
  const RunResult compared = run(compare);
  EXPECT_EQ(compared.exit_code, 0) << compared.err;
  EXPECT_TRUE(contains(compared.out, warning)) << compared.out;
  EXPECT_FALSE(contains(estimate("kinematics", "log.csv", "est.csv"), "warning"));
}

TEST_F(App, AJointWithoutASampleThatCountsHasNoError) {
  simulate_log();
  double time_s = 0;
  rewrite("log.csv", "stops.csv", kLogColumns, kLogColumns, [&](const std::string& name, const std::string& cell) {
    if (name == "time") time_s = std::stod(cell);
    return name == "joint_position_2" && time_s > 0.4 ? "" : cell;
  });
  const std::string printed = estimate("kinematics", "stops.csv", "est.csv");
  EXPECT_TRUE(contains(printed, "joint 1 position error after 0.5 s: RMS ")) << printed;
  EXPECT_TRUE(contains(printed, "joint 2 position error after 0.5 s: no samples\n")) << printed;
  const std::string compared =
      done({"compare", "stops.csv", "--model", "raven2.xml", "--estimators", "kinematics,ekf", "--out", "cmp"});
  EXPECT_TRUE(contains(compared, "  joint 1: mean absolute error ")) << compared;
  EXPECT_TRUE(contains(compared, "  joint 2: no samples after 0.5 s\n")) << compared;
  EXPECT_FALSE(contains(printed + compared, "nan")) << printed << compared;
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
  keep.push_back("time");  // a load that grows to 1 N m
  rewrite("log.csv", "loaded.csv", keep, names, as_is);
  estimate("sr_ukf", "log.csv", "est.csv");
  estimate("sr_ukf", "loaded.csv", "unasked.csv");
  estimate("sr_ukf", "loaded.csv", "asked.csv", {"--use-joint-torque"});
  EXPECT_EQ(text_of(path("unasked.csv")), text_of(path("est.csv")));
  EXPECT_NE(text_of(path("asked.csv")), text_of(path("est.csv")));
}

TEST_F(App, MotorsThatAreReadInTurnAreEstimatedOnceAllHaveBeenRead) {
  simulate_log();
  const std::vector<std::string> names(kLogColumns.begin(), kLogColumns.begin() + 7);
  int cells = 0;
  rewrite("log.csv", "turns.csv", names, names, [&](const std::string& name, const std::string& cell) {
    const bool is_motor = name.starts_with("motor_position");
    return is_motor && cells++ % 4 != 0 ? std::string() : cell;  // motors 1, 2 and 3 in the first three of four rows
  });
  estimate("sr_ukf", "log.csv", "est.csv");
  estimate("sr_ukf", "turns.csv", "turns_est.csv");
  const CsvFile every(path("est.csv")), turns(path("turns_est.csv"));
  ASSERT_EQ(turns.rows.size(), every.rows.size());
  EXPECT_TRUE(contains(text_of(path("turns_est.csv")), "\n0.001,,"));
  EXPECT_FALSE(contains(text_of(path("turns_est.csv")), "\n0.002,,"));
  const std::size_t last = every.rows.size() - 1;
  EXPECT_NEAR(turns.number(last, "joint_position_2"), every.number(last, "joint_position_2"), 1e-3);
}

TEST_F(App, AMeasuredLoadThatIsNotThereIsNoneToUse) {
  simulate_log();
  const std::vector<std::string> line = {"estimate", "--model", "raven2.xml", "--estimator", "ekf",
                                         "--data",   "log.csv", "--out",      "e.csv",       "--use-joint-torque"};
  const RunResult result = run(line);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(contains(result.err, "log.csv: has no column joint_torque_k for --use-joint-torque")) << result.err;
}

TEST_F(App, ALogThatStartsWithoutAllMotorPositionsIsEstimatedFromTheFirstCompleteRow) {
  write_text(path("gap.csv"),
             "time,motor_torque_1,motor_torque_2,motor_torque_3,motor_position_1,motor_position_2,motor_position_3\n"
             "0,0,0,0,107,,904\n0.001,,0,0,107,204,904\n0.002,0,0,0,107,,904\n0.5,0,0,0,107,204,904\n");
  fs::copy(example("raven2.xml"), path("raven2.xml"));
  estimate("kinematics", "gap.csv", "est.csv");
  const std::vector<std::string> lines = lines_of(text_of(path("est.csv")));
  ASSERT_EQ(lines.size(), 6u);  // comment, header, four rows
  EXPECT_EQ(lines[2], "0,,,,,,,,,");
  EXPECT_TRUE(lines[3].starts_with("0.001,0.7")) << lines[3];
  EXPECT_TRUE(lines[5].starts_with("0.5,0.7")) << lines[5];
}

}  // namespace
}  // namespace halyard::testing_program
