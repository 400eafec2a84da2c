// What a user can get wrong: one line on stderr that says where and what, exit code 2, and no output, not even a part.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/bad_input/bad_input.h"

namespace halyard::testing_program {
namespace {

TEST_F(BadInput, ALogThatHasNeverAllMotorsTogether) {
  write_text(path("bad.csv"), kHeader + "0,0,0,0,,204,904\n0.06,0,0,0,,,904\n0.12,0,0,0,107,,904\n");
  expect_estimate_refused("bad.csv",
                          "bad.csv: at no time has every motor been read within 0.1 s; give a log with such a time to "
                          "start from");
}

TEST_F(BadInput, ALogThatIsNotThere) {
  expect_estimate_refused("none.csv", "none.csv: no such file; give the path of a CSV log");
  expect_estimate_refused(".", ".: is a directory; give the path of a CSV log");
}

TEST_F(BadInput, AColumnEntryThatCannotBeMeant) {
  const auto expect_column_refused = [&](const std::string& entry, const std::string& line) {
    expect_line({"estimate", "--model", "raven2.xml", "--estimator", "kinematics", "--data", "log.csv", "--out",
                 "e.csv", "--column", entry},
                line);
  };
  expect_column_refused("motor_torque_1",
                        "column map 'motor_torque_1': 'motor_torque_1' has no '='; expected NAME=COLUMN, such as "
                        "motor_position_1=spindle_rad,sign=-1");
  expect_column_refused("torque_1=motor_torque_1",
                        "column map 'torque_1=motor_torque_1': 'torque_1' is no column of a log; expected one of time, "
                        "motor_torque_k, motor_position_k, joint_position_k, joint_velocity_k, joint_torque_k (k = 1 "
                        "for the first joint), marker_x, marker_y, marker_z");
  expect_column_refused("motor_torque_1=none",
                        "log.csv:1: no column 'none' (mapped to motor_torque_1); the file has 'time', {any}; say which "
                        "column of the file it is, in the model file or by --column motor_torque_1=NAME, or by "
                        "--column motor_torque_1= that the log lacks it");
  expect_column_refused("motor_torque_1=motor_torque_1,unit=deg",
                        "column map 'motor_torque_1=motor_torque_1,unit=deg': column 'motor_torque_1': unit 'deg': "
                        "expected one of N.m, mN.m, N.mm, N, A, mA, V, mV; for any other unit leave it out and give a "
                        "scale to SI");
  expect_column_refused("motor_torque_1=motor_torque_1,scale=0",
                        "column map 'motor_torque_1=motor_torque_1,scale=0': column 'motor_torque_1': expected a "
                        "finite scale other than 0");
  expect_column_refused("motor_torque_4=motor_torque_1",
                        "column map: 'motor_torque_4': the last joint of the arm is 3; remove this column from the "
                        "map");
  expect_refused({"compare", "experiment_a.xml", "--estimators", "kinematics", "--out", "cmp", "--column", "time=t"},
                 {"--column is for logs"});
}

TEST_F(BadInput, ARobotThatIsNotOfTheScenario) {
  const std::string robot = text_of(path("raven2.xml"));
  const std::size_t last = robot.find("<joint name=\"insertion\"");
  write_text(path("two_joints.xml"), robot.substr(0, last) + "</arm>");
  for (const char* command : {"simulate", "compare"}) {
    const auto ask = [&](const char* file) {
      std::vector<std::string> all = {command, "experiment_a.xml", "--robot", file, "--out", "new.csv"};
      if (std::string(command) == "compare") all.insert(all.end(), {"--estimators", "kinematics"});
      return all;
    };
    expect_refused(ask("two_joints.xml"), {"two_joints.xml: its joints are not those of", "raven2.xml"});
    expect_refused(ask("none.xml"), {"none.xml: no such file"});
  }
  expect_refused({"compare", "log.csv", "--model", "raven2.xml", "--robot", "raven2.xml", "--estimators", "kinematics",
                  "--out", "cmp"},
                 {"--robot, --runs and --noise are for scenarios"});
}

TEST_F(BadInput, ASkipBeyondTheRecord) {
  expect_refused({"estimate", "--model", "raven2.xml", "--estimator", "kinematics", "--data", "log.csv", "--out",
                  "e.csv", "--skip", "300"},
                 {"log.csv: lasts", "the first 300 s are skipped", "skip less"});
  expect_refused({"compare", "experiment_a.xml", "--estimators", "kinematics", "--out", "cmp", "--skip", "1e3"},
                 {"experiment_a.xml: lasts", "skip less"});
}

TEST_F(BadInput, AFileThatIsAnotherOrIsNotThere) {
  write_text(path("bad.xml"), "<robot/>");
  expect_refused({"check", "bad.xml"}, {"bad.xml:1: <robot>", "<arm>", "<scenario>", "<sweep>"});
  expect_refused({"estimate", "--model", "bad.xml", "--estimator", "kinematics", "--data", "log.csv", "--out", "e.csv"},
                 {"bad.xml:1: <robot>", "<arm>"});
  expect_refused({"simulate", "raven2.xml", "--out", "new.csv"}, {"raven2.xml:", "<scenario>"});
  expect_refused({"check", "none.xml"}, {"none.xml: no such file"});
  expect_refused({"check", "."}, {".: is a directory"});
}

TEST_F(BadInput, AnIdentificationThatCannotBe) {
  write_moving_log();
  std::string motors;  // the log without its joints' columns
  for (const std::string& line : lines_of(text_of(path("moving.csv")))) {
    std::size_t end = 0;
    for (int cell = 0; cell < 7 && end != line.npos; ++cell) end = line.find(',', end + 1);
    motors += line.substr(0, end) + "\n";
  }
  write_text(path("log.csv"), motors);
  const auto expect_identify_refused = [&](const std::vector<std::string>& more,
                                           const std::vector<std::string>& parts) {
    std::vector<std::string> arguments = {"identify", "--data", "log.csv", "--out", "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_refused(arguments, parts);
  };
  expect_identify_refused({"--model", "raven2.xml", "--parameters", "coupling"},
                          {"log.csv: column joint_position_2 is missing", "--column joint_position_2="});
  expect_identify_refused({"--model", "raven2.xml", "--parameters", "couplings"},
                          {"'couplings'", "raven2.xml", "coupling, stiffness", "joint1.cable.stiffness"});
  expect_identify_refused(
      {"--model", "raven2.xml", "--parameters", "stiffness,,coupling"},
      {"parameter '': raven2.xml has none of that name; expected some of coupling, ", ", with commas between\n"});
  expect_identify_refused({"--model", "raven2.xml", "--parameters", "tension"}, {"'tension'", "law=\"exponential\""});
  expect_identify_refused({"--model", "raven2.xml", "--parameters", "joint1.motor.torque_bias"},
                          {"is 0 in raven2.xml"});
  expect_identify_refused({"--model", "raven2.xml", "--parameters", "coupling", "--data", "log.csv"},
                          {"log.csv: is given twice among --data and --holdout; give each log once\n"});
  expect_identify_refused({"--model", "raven2.xml"}, {"halyard identify: --parameters is required; see "});
  const std::string model = text_of(path("raven2.xml"));
  const std::size_t second = model.find("<joint name=\"elbow\"");
  write_text(path("one_joint.xml"), model.substr(0, second) + "</arm>");
  expect_identify_refused({"--model", "one_joint.xml", "--parameters", "coupling"},
                          {"'coupling'", "one_joint.xml has one joint"});
  expect_refused(
      {"identify", "--data", "moving.csv", "--out", "out", "--model", "raven2.xml", "--parameters", "coupling"},
      {"moving.csv: ", "3 s"});
}

TEST_F(BadInput, AnOutputThatWouldReplaceALog) {
  write_text(path("cmp/comparison.csv"), kHeader + kRows);
  expect_refused({"compare", "cmp/comparison.csv", "--model", "raven2.xml", "--estimators", "kinematics", "--skip", "0",
                  "--out", "cmp"},
                 {"comparison.csv': would replace an input of this command; give another path"});
}

TEST_F(BadInput, AnEstimatorThatCannotBeLoaded) {
  const auto expect_estimator_refused = [&](const std::string& name, const std::string& line) {
    expect_line({"estimate", "--model", "raven2.xml", "--estimator", name, "--data", "log.csv", "--out", "e.csv"},
                line);
    expect_line(
        {"compare", "log.csv", "--model", "raven2.xml", "--estimators", "ekf," + name, "--skip", "0", "--out", "cmp"},
        line);
  };
  write_text(path("text.so"), "not a module\n");
  const std::string broken = HALYARD_BROKEN_PLUGINS;
  expect_estimator_refused("kalman",
                           "no estimator is named 'kalman'; found: camera_sr_ukf disturbance_sr_ukf ekf kinematics "
                           "smoother sr_ukf; give one of these, or the path of a module such as ./kalman.so");
  expect_estimator_refused(std::string(100'000, 'k'),
                           "no estimator is named 'kkk{any}kkk...'; found: camera_sr_ukf disturbance_sr_ukf ekf "
                           "kinematics smoother sr_ukf; give one of these, or the path of a module such as ./" +
                               std::string(80, 'k') + "....so");
  expect_estimator_refused("./text.so",
                           "plugin ./text.so: not a shared module (ELF); give the path of a compiled plug-in (.so)");
  expect_estimator_refused("./none.so", "plugin ./none.so: no such file; check the path");
  expect_estimator_refused(broken + "/older_interface.so",
                           "plugin " + broken +
                               "/older_interface.so: built for interface 1, this program speaks 2; rebuild it against "
                               "the installed headers");
  expect_estimator_refused(broken + "/missing_symbol.so",
                           "plugin " + broken +
                               "/missing_symbol.so: exports no function halyard_estimator; it is no estimator, or its "
                               "function lacks extern \"C\"");
  write_text(path("raven2.xml"),
             replaced(text_of(path("raven2.xml")), "</arm>", "<estimator name=\"kinematics\" colour=\"blue\"/></arm>"));
  expect_estimator_refused("kinematics",
                           "raven2.xml: estimator kinematics: unknown option 'colour'; it has no options");
}

TEST_F(BadInput, AnEstimatorThatBreaksItsPromises) {
  const std::string careless = HALYARD_BROKEN_PLUGINS "/careless.so";
  expect_refused({"check", careless, "--model", "raven2.xml"},
                 {"careless.so: breaks ", "of the promises of an estimator"});
  const std::string broken = HALYARD_BROKEN_PLUGINS;
  expect_refused({"check", broken + "/crashes_in_create.so", "--model", "raven2.xml"},
                 {"crashes_in_create.so: breaks 1 of", "making: crashed: Segm"});
  expect_refused({"check", broken + "/crashes_in_update.so", "--model", "raven2.xml"},
                 {"crashes_in_update.so: breaks 1 of", "plain record: crashed: Segm", "the rest was not tried"});
  expect_refused({"check", broken + "/never_returns.so", "--model", "raven2.xml", "--time-limit", "1"},
                 {"never_returns.so: breaks 1 of", "plain record: took more than 1 s, and was ended"});
  expect_refused({"check", "raven2.xml", "--kalman"}, {"--kalman", "'raven2.xml' is none"});
  EXPECT_TRUE(
      contains(done({"check", HALYARD_PLUGINS "/ekf.so", "--kalman"}), "and is the Kalman filter on a linear arm"));
}

TEST_F(BadInput, AModuleOfEffectsThatCannotBeLoaded) {
  const std::string broken = HALYARD_BROKEN_PLUGINS;
  write_text(path("text.so"), "not a module\n");
  const auto expect_module_refused = [&](const std::string& module, const std::vector<std::string>& parts) {
    const std::vector<std::vector<std::string>> commands = {
        {"check", "raven2.xml"},
        {"simulate", "experiment_a.xml", "--out", "new.csv"},
        {"estimate", "--model", "raven2.xml", "--estimator", "kinematics", "--data", "log.csv", "--out", "e.csv"},
        {"compare", "log.csv", "--model", "raven2.xml", "--estimators", "kinematics", "--out", "cmp"},
        {"diagnose", "--model", "raven2.xml", "--data", "log.csv", "--out", "dia"},
        {"sweep", "sweep.xml", "--out", "out"}};
    for (std::vector<std::string> arguments : commands) {
      arguments.insert(arguments.end(), {"--effects", module});
      expect_refused(arguments, parts);
    }
  };
  expect_module_refused("./text.so",
                        {"plugin ./text.so: not a shared module (ELF); give the path of a compiled plug-in (.so)\n"});
  expect_module_refused("./none.so", {"plugin ./none.so: no such file; check the path\n"});
  expect_module_refused(broken + "/well_formed.so", {"well_formed.so: ", "halyard_effects"});
  expect_module_refused(broken + "/effects_older_interface.so", {"effects_older_interface.so: ", "effect interface 4"});
  for (const std::string name : {"effects_crashes_when_opened.so", "effects_crashes_in_table.so"})
    expect_module_refused(broken + "/" + name, {name + ": as it is loaded: crashed: Segm", "; correct what runs then"});
}

TEST_F(BadInput, AModuleOfEffectsThatHangsAsItIsLoaded) {
  const std::string hangs = HALYARD_BROKEN_PLUGINS "/effects_hangs_when_opened.so";
  expect_refused({"check", hangs, "--time-limit", "1"},
                 {"effects_hangs_when_opened.so: as it is loaded: took more than 1 s, and was ended; correct"});
  expect_refused({"simulate", "experiment_a.xml", "--out", "new.csv", "--effects", hangs},
                 {"effects_hangs_when_opened.so: as it is loaded: took more than 10 s, and was ended; correct"});
}

TEST_F(BadInput, AnEffectOfAModuleThatThrowsNoStandardException) {
  const std::string effect = R"(<effects><effect name="fixture_torn_spring" joint="1" stiffness="60"/></effects>)";
  write_text(path("torn.xml"), replaced(text_of(path("experiment_a.xml")), "</scenario>", effect + "</scenario>"));
  expect_refused(
      {"simulate", "torn.xml", "--out", "new.csv", "--effects", HALYARD_BROKEN_PLUGINS "/effects_throwing_force.so"},
      {"halyard: an exception of unknown type, perhaps from an effect of a module\n"}, 1);
}

TEST_F(BadInput, ASweepThatCannotBeComputed) {
  const std::string good = "<axis parameter=\"joint1.cable.stiffness\" values=\"1e5 2e5\"/>";
  expect_sweep_refused("<axis parameter=\"joint1.effect.backlsh.half_gap\" values=\"1\"/>", {"backlsh", "backlash"});
  expect_sweep_refused("<axis parameter=\"joint1.effect.backlash.gap\" values=\"1\"/>", {"backlash.gap", "half_gap"});
  expect_sweep_refused("<axis parameter=\"joint9.effect.backlash.half_gap\" values=\"1\"/>", {"joint9", "1 to 3"});
  expect_sweep_refused("<axis parameter=\"joint0.effect.delay.command_delay\" values=\"1\"/>", {"joint0", "1 to 3"});
  expect_sweep_refused("<axis parameter=\"joint0.effect.payload.mass\" values=\"1\"/>", {"arm.effect.payload.mass"});
  expect_sweep_refused("<axis parameter=\"joint1.cable.stiffness\" values=\"1e5 x\"/>", {"bad.xml:1:", "1e5 x"});
  expect_sweep_refused("<axis parameter=\"joint1.cable.stiffness\"/>", {"values", "from"});
  expect_sweep_refused("<axis parameter=\"joint1.cable.stiffness joint1.link.mass\" values=\"1\"/>", {"kg", "N/m"});
  expect_sweep_refused(good + good, {"varied twice"});
  expect_sweep_refused(good, {"kinematics,,ekf", "empty name"}, "estimators=\"kinematics,,ekf\"");
  expect_sweep_refused(good, {"measures=\"ness\"", "expected one or more of errors, nees"},
                       "estimators=\"ekf\" measures=\"ness\"");
  expect_sweep_refused(good, {"limits=\"backlsh\"", "no effect", "backlash"}, "limits=\"backlsh\"");
  expect_sweep_refused("<axis parameter=\"estimator.ekf.torque_noise\" values=\"1\"/>",
                       {"a sweep of limits runs no estimator"}, "limits=\"backlash\"");
  expect_sweep_refused(good, {"estimators=\"ekf\"", "beside limits"}, "limits=\"backlash\" estimators=\"ekf\"");
  expect_sweep_refused(replaced(good, "/>", " applies_to=\"robot\"/>"), {"as the model says"}, "limits=\"backlash\"");
  expect_sweep_refused("<axis parameter=\"joint2.effect.backlash.half_gap\" values=\"0 1e-4\"/>",
                       {"puts an effect into the model whose limits are measured"}, "limits=\"backlash\"");
  expect_sweep_refused(good, {"measures=\"time\"", "add errors"}, "estimators=\"ekf\" measures=\"time\"");
  expect_sweep_refused(good, {"samples=\"8\"", "a grid has none"}, "estimators=\"ekf\" samples=\"8\"");
  expect_sweep_refused(good, {"design=\"sobel\"", "latin_hypercube"}, "estimators=\"ekf\" design=\"sobel\"");
  expect_sweep_refused(good, {"samples", "missing"}, "estimators=\"ekf\" design=\"sobol\"");
  expect_sweep_refused(good, {"belongs to a grid"}, "estimators=\"ekf\" design=\"sobol\" samples=\"8\"");
  expect_sweep_refused(good, {"raven.xml"}, "estimators=\"ekf\" model=\"raven.xml\"");
  expect_sweep_refused(good, {"duration=\"1e-4\"", "at least one control period"},
                       "estimators=\"ekf\" duration=\"1e-4\"");

  const auto axis = [](const std::string& key, const std::string& rest) {
    return "<axis parameter=\"" + key + "\" " + rest + "/>";
  };
  expect_sweep_refused(axis("control.perid", "values=\"1e-3\""), {"bad.xml:1:", "control.perid", "control.period"});
  expect_sweep_refused(axis("camera.rate", "values=\"10\""), {"camera.rate", "the scenario has none of that name"});
  expect_sweep_refused(axis("joint1.trajectory.center", "values=\"2\""), {"bad.xml, at", "the joint's range"});
  expect_sweep_refused(axis("joint1.sensors.torque_noise", "values=\"1e-3\" applies_to=\"model\""),
                       {"bad.xml:1:", "not of the model"});
  expect_sweep_refused(axis("joint1.encoders.joint_resolution", "values=\"-1\""), {"joint_resolution = -1 rad, robot"});
  expect_sweep_refused(axis("estimator.ekf.torque_noise", "values=\"1e-3\""),
                       {"bad.xml:1:", "does not run", "kinematics"});
  expect_sweep_refused(axis("estimator.ekf.torque_nois", "values=\"1e-3\""), {"torque_nois", "joint_force_noise"},
                       "estimators=\"ekf\" skip=\"0\"");
}

TEST_F(BadInput, PartsOfASweepThatDoNotBelongTogether) {
  const auto write_sweep = [&](const std::string& values) {
    write_text(path("sweep.xml"),
               "<sweep name=\"x\" scenario=\"experiment_a.xml\" skip=\"0\" estimators=\"kinematics\"><axis "
               "parameter=\"joint1.cable.stiffness\" values=\"" +
                   values + "\"/></sweep>");
  };
  write_sweep("1e5 2e5");
  done({"sweep", "sweep.xml", "--out", "part1", "--shard", "1/2"});
  expect_refused({"merge", "part1", "--out", "all"}, {"1 of 2 points", "joint1.cable.stiffness = 200000 N/m"});
  expect_refused({"merge", "part1", "none", "--out", "all"}, {"none: holds no sweep.json"});
  write_sweep("1e5 3e5");
  done({"sweep", "sweep.xml", "--out", "part2", "--shard", "2/2"});
  expect_refused({"merge", "part1", "part2", "--out", "all"}, {"part2: holds another sweep than part1"});
  expect_refused({"sweep", "sweep.xml", "--out", "part1", "--resume"}, {"part1: holds results of another sweep"});
  const fs::path journal = path("part2/cells/2_of_2.jsonl");
  write_text(journal, text_of(journal) + "{\"id\":\n");
  expect_refused({"merge", "part2", "--out", "all"}, {"part2/cells/2_of_2.jsonl", "damaged"});
  expect_refused({"sweep", "sweep.xml", "--out", "none", "--status"}, {"none: holds no sweep.json"});
  expect_refused({"sweep", "sweep.xml", "--out", "part1", "--status"}, {"part1: holds results of another sweep"});
  expect_refused({"sweep", "sweep.xml", "--point", "2"}, {"--point 2", "0 to 1"});
  expect_refused({"sweep", "sweep.xml"}, {"halyard sweep: --out is required; see "});
  expect_refused({"sweep", "sweep.xml", "--out", "out", "--nodes", "2"}, {"--nodes", "--slurm"});
  expect_refused({"sweep", "sweep.xml", "--out", "out", "--status", "--slurm"}, {"--slurm excludes --status; see "});
  write_text(path("part2/sweep.json"), replaced(text_of(path("part2/sweep.json")), "300000", "300000.0, 4"));
  expect_refused({"merge", "part2", "--out", "all"}, {"part2/sweep.json", "damaged"});
  for (const char* shard : {"0/2", "3/2", "1", "a/b", "1/2x", "-1/2"}) {
    expect_refused({"sweep", "sweep.xml", "--out", "out", "--shard", shard}, {"--shard", "2/5"});
  }
}

TEST_F(BadInput, AnOutputThatCannotBeWritten) {
  expect_line({"simulate", "experiment_a.xml", "--out", "."}, "--out '.': is a folder; give a file name");
  expect_line({"simulate", "experiment_a.xml", "--out", ""}, "--out '': is empty; give a file name");
  expect_refused({"simulate", "experiment_a.xml", "--out", "log.csv/new.csv"}, {"log.csv", "is not a folder"});
  expect_refused({"compare", "experiment_a.xml", "--estimators", "kinematics", "--out", "log.csv"},
                 {"is not a folder"});
  const std::vector<std::string> estimate = {"estimate",   "--model", "raven2.xml", "--estimator",
                                             "kinematics", "--data",  "log.csv",    "--out"};
  for (const char* input : {"log.csv", "raven2.xml"}) {
    std::vector<std::string> arguments = estimate;
    arguments.push_back(input);
    expect_refused(arguments, {"would replace an input"});
  }
  for (const char* input : {"experiment_a.xml", "raven2.xml"})
    expect_refused({"simulate", "experiment_a.xml", "--out", input}, {"would replace an input"});
  fs::create_directories(path("old"));
  fs::copy_file(path("raven2.xml"), path("old/model.xml"));
  expect_refused({"diagnose", "--model", "old/model.xml", "--data", "log.csv", "--out", "old"},
                 {"model.xml", "would replace an input"});
}

TEST_F(BadInput, AFolderInPlaceOfAModule) {
  fs::create_directories(path("folder.so"));
  expect_refused({"check", "folder.so"}, {"plugin folder.so: not a file; give the path of a module (.so)"});
}

TEST_F(BadInput, AScenarioOfAnotherKindOfArm) {
  write_text(path("turned.xml"), replaced(text_of(path("raven2.xml")), "type=\"prismatic\"", "type=\"revolute\""));
  expect_refused({"diagnose", "--plan", "turned.xml", "experiment_a.xml"},
                 {"experiment_a.xml: its robot's joints are not of the types of those of turned.xml"});
}

TEST_F(BadInput, AFailureThatIsNotTheUsersIsExitCode1AndLeavesNothing) {
  std::string rows;
  for (const char* time : {"0", "0.001", "0.002", "0.003"}) rows += std::string(time) + ",0,0,0,107,204,904\n";
  write_text(path("log.csv"), kHeader + rows);
  const std::string broken = std::string(HALYARD_BROKEN_PLUGINS) + "/throws_in_update.so";
  expect_refused({"estimate", "--model", "raven2.xml", "--estimator", broken, "--data", "log.csv", "--out", "e.csv"},
                 {"throws_in_update", "log.csv at 0.002 s"}, 1);
  expect_refused({"compare", "log.csv", "--model", "raven2.xml", "--estimators", broken, "--skip", "0", "--out", "cmp"},
                 {"throws_in_update"}, 1);
}

TEST_F(BadInput, AnEstimatorThatFailsEndsItsOwnRowOfTheComparison) {
  std::string rows, names = "kinematics";
  for (const char* time : {"0", "0.001", "0.002", "0.003"}) rows += std::string(time) + ",0,0,0,107,204,904\n";
  write_text(path("log.csv"), kHeader + rows);
  const std::vector<std::pair<std::string, std::string>> broken = {{"throws_in_update", "at 0.002 s"},
                                                                   {"crashes_in_create", "being made: crashed: Segm"},
                                                                   {"crashes_in_update", "at 0.002 s: crashed: Segm"},
                                                                   {"never_returns", "at 0.002 s: took more than 2 s"}};
  for (const auto& [module, failure] : broken)
    names.append("," HALYARD_BROKEN_PLUGINS "/").append(module).append(".so");
  const RunResult run = this->run({"compare", "log.csv", "--model", "raven2.xml", "--estimators", names + ",ekf",
                                   "--out", "cmp", "--skip", "0", "--step-limit", "2"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json result = nlohmann::json::parse(text_of(path("cmp/comparison.json"))).at("estimators");
  ASSERT_EQ(result.size(), broken.size() + 2);
  EXPECT_TRUE(result.front().at("failure").is_null());
  EXPECT_TRUE(result.back().at("failure").is_null());
  for (std::size_t i = 0; i < broken.size(); ++i) {
    EXPECT_TRUE(contains(run.err, broken[i].second)) << run.err;
    EXPECT_TRUE(contains(result.at(i + 1).at("failure").get<std::string>(), broken[i].second));
    EXPECT_TRUE(contains(text_of(path("cmp/report.html")), broken[i].second));
  }
}

TEST_F(BadInput, AnEstimatorThatCrashesAsItIsMadeFailsEachOfManyRuns) {
  write_text(path("scenario.xml"), "<scenario name=\"short\" model=\"raven2.xml\" duration=\"0.1\" seed=\"1\"/>");
  const RunResult run = this->run({"compare", "scenario.xml", "--estimators",
                                   "kinematics," + std::string(HALYARD_BROKEN_PLUGINS) + "/crashes_in_create.so",
                                   "--runs", "2", "--skip", "0", "--out", "cmp"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json result = nlohmann::json::parse(text_of(path("cmp/comparison.json")));
  EXPECT_TRUE(contains(result.dump(), "being made: crashed: Segm")) << result.dump(2);
}

}  // namespace
}  // namespace halyard::testing_program
