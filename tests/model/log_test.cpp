#include "model/log.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "model/input_error.h"
#include "tests/support/message_of.h"

namespace halyard {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

std::filesystem::path temporary_path() {
  return std::filesystem::path(testing::TempDir()) /
         ("halyard_log_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".csv");
}

Log read_text(const std::string& text, const ColumnMap& map = {}, const ReadOptions& options = {}) {
  std::ofstream(temporary_path(), std::ios::binary) << text;
  return read_log(temporary_path(), 1, map, options);
}

/// The message for a log of one joint with this content; the path is cut off.
std::string refusal_of(const std::string& text, const ColumnMap& map = {}) {
  const std::string message = message_of([&] { read_text(text, map); });
  const std::string path = temporary_path().string();
  return message.starts_with(path) ? message.substr(path.size()) : message;
}

ColumnMap map_of(const std::vector<std::string>& entries) {
  ColumnMap map;
  for (const std::string& entry : entries) map.add_entry(entry);
  return map;
}

const std::string kHeader = "time,motor_torque_1,motor_position_1\n";

#define EXPECT_HAS(message, part) EXPECT_PRED_FORMAT2(testing::IsSubstring, part, message)

TEST(ReadLog, TakesStandardColumnsInAnyOrder) {
  const Log log = read_text("motor_position_1,joint_position_1,time,motor_torque_1\n3,4,1,2\n7,8,5.5,-6e-1\n");
  EXPECT_EQ(log.time, (std::vector<double>{1, 5.5}));
  EXPECT_EQ(log.motor_torque[0], (std::vector<double>{2, -0.6}));
  EXPECT_EQ(log.motor_position[0], (std::vector<double>{3, 7}));
  EXPECT_EQ(log.joint_position[0], (std::vector<double>{4, 8}));
  EXPECT_TRUE(log.has_joint_position(0));
  EXPECT_TRUE(log.joint_velocity[0].empty());
  EXPECT_EQ(log.duration(), 4.5);
  EXPECT_EQ(log.source, temporary_path().string());
}

TEST(ReadLog, AcceptsWhatOtherProgramsWrite) {
  const Log log = read_text(
      "\xEF\xBB\xBF# rig 7\r\n\"time\", motor_torque_1 ,motor_position_1\r\n"
      "# start\r\n0,+1,.5\r\n\r\n 1 ,2,\t5.\r\n2,3,4");
  EXPECT_EQ(log.time, (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(log.motor_torque[0], (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(log.motor_position[0], (std::vector<double>{0.5, 5, 4}));
}

TEST(ReadLog, EmptyCellIsMissingSample) {
  const Log log = read_text("time,motor_torque_1,motor_position_1,joint_position_1\n0,,1,\n1,2,,\n");
  EXPECT_TRUE(std::isnan(log.motor_torque[0][0]));
  EXPECT_EQ(log.motor_torque[0][1], 2);
  EXPECT_TRUE(std::isnan(log.motor_position[0][1]));
  EXPECT_FALSE(log.has_joint_position(0)) << "a column without a sample counts as absent";
}

TEST(ReadLog, IgnoresOtherColumnsAndNamesThem) {
  const Log log = read_text("time,note,motor_torque_1,motor_position_1,motor_position_2,note\n0,a b,1,2,nan,\n");
  EXPECT_EQ(log.ignored_columns, (std::vector<std::string>{"note", "motor_position_2", "note"}));
}

TEST(ReadLog, AMarkerHasThreeAxesOrNone) {
  const std::string start = "time,motor_torque_1,motor_position_1,marker_x,marker_y";
  const Log log = read_text(start + ",marker_z\n0,1,2,,,\n1,1,2,3,4,5\n");
  EXPECT_TRUE(log.has_marker());
  EXPECT_TRUE(std::isnan(log.marker[1][0]));
  EXPECT_EQ(log.marker[2][1], 5);
  EXPECT_FALSE(read_text("time,motor_torque_1,motor_position_1\n0,1,2\n").has_marker());
  EXPECT_HAS(refusal_of(start + "\n0,1,2,3,4\n"), ": no marker_z beside the marker's other axes; give all three of ");
  EXPECT_EQ(read_text(start + ",up_mm\n0,1,2,3,4,5\n", map_of({"marker_z=up_mm,unit=mm"})).marker[2][0], 5e-3);
}

TEST(ReadLog, TorqueIsOptionalOnRequest) {
  EXPECT_HAS(refusal_of("time,motor_position_1\n0,1\n"), ":1: no column 'motor_torque_1'; the file has 'time', ");
  EXPECT_FALSE(read_text("time,motor_position_1\n0,1\n", {}, {.torque_required = false}).has_motor_torque(0));
}

TEST(ReadLog, AJointWithoutMotorNeedsNoColumnsOfOne) {
  const std::string text = "time,joint_position_1\n0,1\n1,2\n";
  EXPECT_HAS(refusal_of(text), ": no column 'motor_torque_1', 'motor_position_1'; ");
  const Log log = read_text(text, {}, {.without_motor = {0}});
  EXPECT_TRUE(log.motor_position[0].empty());
  EXPECT_EQ(log.joint_position[0], (std::vector<double>{1, 2}));
}

TEST(ReadLog, ColumnsOfAMotorThatTheArmDoesNotHaveAreNotRead) {
  const std::string text = "time,motor_torque_1,motor_position_1,joint_position_1\n0,somebody else's,,1\n1,3,4,2\n";
  const Log log = read_text(text, {}, {.without_motor = {0}});
  EXPECT_TRUE(log.motor_torque[0].empty());
  EXPECT_TRUE(log.motor_position[0].empty());
  EXPECT_EQ(log.joint_position[0], (std::vector<double>{1, 2}));
  EXPECT_EQ(log.ignored_columns, (std::vector<std::string>{"motor_torque_1", "motor_position_1"}));
}

TEST(ReadLog, ClockThatBeganLongBeforeCountsFromTheFirstSample) {
  const Log log = read_text(kHeader + "1763700000.25,1,2\n1763700000.5,1,2\n");
  EXPECT_EQ(log.clock_start, 1763700000.25);
  EXPECT_EQ(log.time, (std::vector<double>{0, 0.25}));
  EXPECT_EQ(read_text(kHeader + "1000,1,2\n").clock_start, 1000);
  EXPECT_EQ(read_text(kHeader + "12.5,1,2\n").clock_start, 0);
  EXPECT_EQ(read_text(kHeader + "12.5,1,2\n").time[0], 12.5);
}

TEST(WriteLog, KeepsTheClockThatTheLogWasReadWith) {
  const Log log = read_text(kHeader + "1763700000.25,1,2\n1763700000.5,1,2\n");
  EXPECT_TRUE(log_csv(log).ends_with("\n1763700000.25,1,2\n1763700000.5,1,2\n")) << log_csv(log);
}

TEST(ReadLog, SaysWhatIsWrongWithTheFile) {
  const auto path = temporary_path();
  std::filesystem::remove(path);
  EXPECT_EQ(message_of([&] { read_log(path, 1); }), path.string() + ": no such file; give the path of a CSV log");
  EXPECT_HAS(message_of([] { read_log(testing::TempDir(), 1); }), ": is a directory; ");
  EXPECT_HAS(refusal_of(""), ": is empty; ");
  EXPECT_HAS(refusal_of("# only a comment\n\n"), ": is empty; ");
  EXPECT_HAS(refusal_of(kHeader), ": has a header but no samples; ");
  EXPECT_HAS(refusal_of(std::string("PK\3\4,\0\n", 7)), ": is not text; ");
  EXPECT_HAS(refusal_of("time;motor_torque_1;motor_position_1\n0;1;2\n"), ":1: the columns are separated by semi");
  EXPECT_HAS(refusal_of("# no header\n0.5,1,2\n"), ":2: the first row starts with the number '0.5'; ");
  EXPECT_THROW(read_log(path, 0), std::invalid_argument);
}

TEST(ReadLog, SaysWhichColumnIsWrong) {
  EXPECT_EQ(
      refusal_of("\nt_s,motor_torque_1,spindle\n0,1,2\n"),
      ":2: no column 'time', 'motor_position_1'; the file has 't_s', 'motor_torque_1', 'spindle'; say which column "
      "of the file it is, in the model file or by --column time=NAME");
  EXPECT_HAS(refusal_of("time,motor_torque_1,motor_position_1,time\n0,1,2,3\n"), ":1: column 'time' stands twice");
  EXPECT_HAS(refusal_of(kHeader + "0,1,\n1,2,\n"), ": motor_position_1 is empty in every row; ");
}

TEST(ReadLog, SaysWhichRowIsWrong) {
  EXPECT_EQ(refusal_of(kHeader + "0,1,2\n1,1.5volt,2\n"),
            ":3: column 'motor_torque_1': '1.5volt' is not a number; write a finite decimal number, or leave the cell "
            "empty for a missing sample");
  for (const std::string text : {"nan", "NaN", "inf", "-Infinity", "0x1p3", "1e999", "--1", "+-1", "+", "\x01\x02"}) {
    EXPECT_NE(refusal_of(kHeader + "0,1," + text + "\n"), "no InputError") << text;
  }
  EXPECT_HAS(refusal_of(kHeader + "0,1,2\n# c\n0.5,1\n"), ":4: the row has 2 cells, the header 3; ");
  EXPECT_HAS(refusal_of(kHeader + "0,1,2,\n"), ":2: the row has 4 cells, the header 3; ");
  EXPECT_HAS(refusal_of(kHeader + ",1,2\n"), ":2: the time is missing; ");
  EXPECT_HAS(refusal_of(kHeader + "0.5,1,2\n0.25,1,2\n"), ":3: time 0.25 s follows 0.5 s; time must increase: ");
  EXPECT_HAS(refusal_of(kHeader + "0,1,2\n0,1,2\n"), ":3: time 0 s follows 0 s; ");
}

TEST(ColumnMap, ScalesUnitsSignsAndOffsets) {
  const ColumnMap map = map_of({"time=t,unit=ms", "motor_torque_1=tau, unit=mN.m, sign=-1, scale=2, offset=0.5",
                                "motor_position_1=angle,unit=turn", "joint_position_1=angle,unit=deg"});
  const Log log = read_text("t,tau,angle\n1000,250,90\n2000,,180\n", map);
  EXPECT_DOUBLE_EQ(log.time[1], 2);
  EXPECT_DOUBLE_EQ(log.motor_torque[0][0], -2 * 0.250 + 0.5);
  EXPECT_TRUE(std::isnan(log.motor_torque[0][1]));
  EXPECT_DOUBLE_EQ(log.motor_position[0][0], 90 * 2 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(log.joint_position[0][1], std::numbers::pi);
  EXPECT_TRUE(log.ignored_columns.empty());
}

TEST(ColumnMap, UnwrapsAPositionInTheUnitsOfTheFile) {
  const ColumnMap map =
      map_of({"time=t", "motor_torque_1=tau", "motor_position_1=q,unit=deg,sign=-1,offset=1,wrap=360"});
  const Log log = read_text("t,tau,q\n0,0,350\n1,0,20\n2,0,\n3,0,100\n4,0,355\n5,0,355\n", map);
  const std::vector<double> unwrapped = {350, 380, 0, 460, 355, 355};  // the third is missing
  for (const std::size_t i : {0, 1, 3, 4, 5})
    EXPECT_NEAR(log.motor_position[0][i], 1 - unwrapped[i] * std::numbers::pi / 180, 1e-12) << i;
  EXPECT_TRUE(std::isnan(log.motor_position[0][2]));
}

TEST(ColumnMap, LeavesOtherStandardColumnsTheirNames) {
  const Log log = read_text("t_s,motor_torque_1,motor_position_1\n0,1,2\n", map_of({"time=t_s"}));
  EXPECT_EQ(log.motor_position[0][0], 2);
}

TEST(ColumnMap, GivesNoColumnToTwoJoints) {
  const std::string text =
      "time,motor_torque_1,motor_position_1,motor_torque_2,motor_position_2,joint_position_2\n0,1,2,3,4,5\n";
  const auto read = [&](const std::string& entry) {
    std::ofstream(temporary_path(), std::ios::binary) << text;
    return read_log(temporary_path(), 2, map_of({entry}));
  };
  EXPECT_HAS(message_of([&] { read("motor_position_1=motor_position_2"); }),
             ":1: column 'motor_position_2' is read as motor_position_1 and as motor_position_2; map each of them to");
  // A drive without a sensor behind it has one position.
  EXPECT_EQ(read("joint_position_2=motor_position_2").joint_position[1][0], 4);
}

TEST(ColumnMap, OverridesByName) {
  ColumnMap map = map_of({"time=a,unit=ms", "joint_position_2=b"});
  map.override_with(map_of({"time=c"}));
  EXPECT_EQ(map.sources().at("time").column, "c");
  EXPECT_EQ(map.sources().at("time").scale, 1);
  EXPECT_EQ(map.sources().at("joint_position_2").column, "b");
}

TEST(ColumnMap, SaysWhatIsWrongWithAnEntry) {
  const auto message = [](const std::string& entry) { return message_of([&] { map_of({entry}); }); };
  EXPECT_EQ(message("motor_torque_1=tau,unit=deg"),
            "column map 'motor_torque_1=tau,unit=deg': column 'motor_torque_1': unit 'deg': expected one of N.m, mN.m, "
            "N.mm, N, A, mA, V, mV; for any other unit leave it out and give a scale to SI");
  EXPECT_HAS(message("time=t,unit=h"), "unit 'h': expected one of s, ms, us; ");
  EXPECT_HAS(message("motor_pos_1=a"),
             "'motor_pos_1' is no column of a log; expected one of time, motor_torque_k, motor_position_k, "
             "joint_position_k, joint_velocity_k, joint_torque_k (k = 1 for the first joint)");
  for (const std::string name :
       {"motor_position", "motor_position_0", "motor_position_01", "position_1", "time_1", ""}) {
    EXPECT_HAS(message(name + "=a"), "is no column of a log");
  }
  EXPECT_HAS(message("motor_position_1"), "'motor_position_1' has no '='; expected NAME=COLUMN");
  EXPECT_HAS(message("time=t,"), "'' has no '='");
  for (const std::string name : {"time", "motor_position_1"})
    EXPECT_HAS(message(name + "="), "column '" + name + "': no column is named, but every log has it");
  EXPECT_HAS(message("joint_position_1=,unit=deg"), "column 'joint_position_1': no column is named; name the column");
  for (const std::string name : {"motor_torque_1", "marker_x", "time"})
    EXPECT_HAS(message(name + "=a,wrap=360"), "only a motor's or a joint's position wraps around; leave wrap out here");
  EXPECT_HAS(message("motor_position_1=q,wrap=-360"), "expected a wrap of at least 0: the period of the reading");
  EXPECT_HAS(message("time=t,factor=2"),
             "'factor' is no setting of a column; expected unit=, sign=, scale=, offset= or wrap=");
  EXPECT_HAS(message("time=t,scale=2,scale=3"), "'scale' is given twice");
  EXPECT_HAS(message("time=t,scale=fast"), "scale 'fast': expected a number");
  EXPECT_HAS(message("time=t,scale=0"), "expected a finite scale other than 0");
  EXPECT_HAS(message("time=t,sign=2"), "expected sign 1 or -1");
  EXPECT_HAS(message_of([] { map_of({"time=a", "time=b"}); }), "is mapped twice");
}

TEST(ColumnMap, AColumnThatIsLeftOutIsNotRead) {
  ColumnMap map = map_of({"joint_position_1=q", "joint_torque_1=load"});
  map.override_with(map_of({"joint_position_1=", "joint_torque_1="}));
  const Log log = read_text("time,motor_torque_1,motor_position_1,joint_position_1\n0,1,2,3\n", map);
  EXPECT_FALSE(log.has_joint_position(0));
  EXPECT_TRUE(log.joint_torque[0].empty());
  EXPECT_HAS(refusal_of(kHeader + "0,1,2\n", map_of({"motor_torque_1="})),
             ":1: 'motor_torque_1' is left out but needed here; say which column of the file it is by --column "
             "motor_torque_1=NAME, or do not leave it out");
}

TEST(ColumnMap, OfAnotherLoggerDoesNotReadALogOfHalyardsOwn) {
  EXPECT_HAS(refusal_of(kHeader + "0,1,2\n", map_of({"time=t_ms,unit=ms", "motor_position_1=enc"})),
             ":1: has the column names of halyard's own logs, but none of the columns that <columns> or --column ask "
             "for; read "
             "it with a model without <columns>, and without --column");
}

TEST(ColumnMap, MustFitFileAndArm) {
  EXPECT_HAS(refusal_of("t,motor_torque_1,motor_position_1\n0,1,2\n", map_of({"time=t", "joint_torque_1=load"})),
             ":1: no column 'load' (mapped to joint_torque_1); the file has 't', 'motor_torque_1', 'motor_position_1'; "
             "say which column of the file it is, in the model file or by --column joint_torque_1=NAME, or by --column "
             "joint_torque_1= that the log lacks it");
  EXPECT_HAS(refusal_of(kHeader, map_of({"joint_position_2=q2"})),
             "column map: 'joint_position_2': the last joint of the arm is 1; ");
  EXPECT_HAS(refusal_of(kHeader + "0,1,1e300\n", map_of({"motor_position_1=motor_position_1,scale=1e300"})),
             ":2: column 'motor_position_1': '1e300' is too large once scaled");
}

TEST(WriteLog, WritesTheDocumentedText) {
  Log log(2);
  log.time = {0, 0.001, 1.5};
  log.motor_position = {{1, kMissing, -2.5e-7}, {1. / 3, 4, 123456789.25}};
  log.joint_torque[1] = {0, 1, kMissing};
  write_log(temporary_path(), log, "seed 3\nsecond line");
  std::ostringstream text;
  text << std::ifstream(temporary_path()).rdbuf();
  EXPECT_EQ(text.str(),
            "# seed 3\n# second line\ntime,motor_position_1,motor_position_2,joint_torque_2\n"
            "0,1,0.333333333,0\n0.001,,4,1\n1.5,-2.5e-07,123456789,\n");
}

TEST(WriteLog, ReadsBackWhatItWrote) {
  Log log(3);
  for (int i = 0; i < 100; ++i) {
    log.time.push_back(i * 1e-3);
    for (int k = 0; k < 3; ++k) {
      log.motor_torque[k].push_back(std::sin(i + k) * 1e-4);
      log.motor_position[k].push_back(i == 50 ? kMissing : 900 * std::cos(i - k));
    }
    log.joint_velocity[2].push_back(std::exp(-i));
  }
  write_log(temporary_path(), log);
  const Log back = read_log(temporary_path(), 3);
  ASSERT_EQ(back.size(), log.size());
  for (std::size_t i = 0; i < log.size(); ++i) {
    EXPECT_NEAR(back.time[i], log.time[i], 0.5e-6);  // 6 decimals
    // 9 significant digits: at most half a unit of the ninth.
    EXPECT_NEAR(back.motor_torque[1][i], log.motor_torque[1][i], 0.5e-8 * std::abs(log.motor_torque[1][i]));
    EXPECT_NEAR(back.joint_velocity[2][i], log.joint_velocity[2][i], 0.5e-8 * log.joint_velocity[2][i]);
    EXPECT_EQ(std::isnan(back.motor_position[0][i]), i == 50);
  }
  EXPECT_TRUE(back.joint_velocity[0].empty());
}

// Linux answers a read of the memory at address 0 by EIO, as a bad disk does.
TEST(ReadLog, AFileThatCannotBeReadToItsEndIsNoShorterLog) {
  EXPECT_EQ(message_of([] { read_log("/proc/self/mem", 1); }),
            "/proc/self/mem: cannot be read; check its permissions and its disk");
}

TEST(WriteLog, RefusesWhatCouldNotBeReadBack) {
  std::filesystem::remove(temporary_path());
  Log log(1);
  log.motor_position[0] = {1, 2};
  for (const std::vector<double>& time : {std::vector<double>{0}, {1, 1}, {2, 1}, {1, 1 + 1e-8}, {0, kMissing}}) {
    log.time = time;
    EXPECT_THROW(write_log(temporary_path(), log), std::invalid_argument);
  }
  log.time = {0, 1};
  log.motor_position[0][1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(write_log(temporary_path(), log), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(temporary_path()));
}

TEST(Slice, CutsEveryColumn) {
  const Log log = read_text(kHeader + "0,1,2\n1,3,4\n2,5,6\n");
  const Log part = slice(log, 1, 3);
  EXPECT_EQ(part.time, (std::vector<double>{1, 2}));
  EXPECT_EQ(part.motor_position[0], (std::vector<double>{4, 6}));
  EXPECT_TRUE(part.joint_torque[0].empty());
  EXPECT_EQ(slice(log, 2, 2).size(), 0);
  EXPECT_THROW(slice(log, 2, 4), std::out_of_range);
  EXPECT_THROW(slice(log, 2, 1), std::out_of_range);
}

#ifndef HALYARD_SHARED_DATA
#define HALYARD_SHARED_DATA "../shared/data"
#endif

std::filesystem::path shared(const std::string& file) { return std::filesystem::path(HALYARD_SHARED_DATA) / file; }

#define SKIP_WITHOUT(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "shared data not found: " << (path)

TEST(SharedData, RigLogIsRead) {
  const auto path = shared("rig/clean-1/train.csv");
  SKIP_WITHOUT(path);
  const Log log = read_log(path, 3);
  EXPECT_EQ(log.size(), 30001);
  EXPECT_EQ(log.duration(), 30);
  EXPECT_EQ(log.motor_position[2][0], 904.426826);
  EXPECT_TRUE(log.has_joint_position(2));
  EXPECT_TRUE(log.ignored_columns.empty());
}

TEST(SharedData, ForeignLogIsReadByMap) {
  const auto path = shared("davinci_tool/run_L4_00.csv");
  SKIP_WITHOUT(path);
  const Log log =
      read_log(path, 1,
               map_of({"time=t_s", "motor_position_1=spindle_pos_rad", "motor_torque_1=spindle_torque_Nm,unit=N.m",
                       "joint_position_1=jaw_pos_rad,unit=rad,sign=-1"}));
  EXPECT_EQ(log.size(), 19977);
  EXPECT_EQ(log.motor_position[0][0], 1.04617);
  EXPECT_EQ(log.joint_position[0][0], -0.296881);
  EXPECT_EQ(log.ignored_columns.size(), 5);
}

TEST(SplitLog, CutsInTime) {
  Log log(1);
  // A gap in the second half: time counts, not samples.
  log.time = {0, 1, 2, 3, 7, 9};
  log.motor_position[0] = {0, 1, 2, 3, 4, 5};
  const auto [first, rest] = split_log(log, 2.0 / 3);
  EXPECT_EQ(first.time, (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(rest.time, (std::vector<double>{7, 9}));
  EXPECT_EQ(rest.motor_position[0], (std::vector<double>{4, 5}));
}

}  // namespace
}  // namespace halyard
