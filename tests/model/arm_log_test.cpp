#include "model/arm_log.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "model/model_file.h"
#include "tests/support/message_of.h"

namespace halyard {
namespace {

class ArmLog : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(path_) << "time,motor_torque_1,motor_position_1,motor_torque_2,motor_position_2,motor_torque_3,"
                            "motor_position_3,turns,note\n"
                            "0,0,1,0,2,0,3,0.5,7\n"
                            "0.001,0,1,0,2,0,3,0.5,7\n";
    model_.columns.add_entry("motor_position_1=turns,scale=10");
  }
  void TearDown() override { std::filesystem::remove(path_); }

  ArmModel model_ = read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml");
  const std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + "_arm_log.csv");
};

TEST_F(ArmLog, IsReadByTheModelsColumnMap) {
  const Log log = read_log_of(model_, path_);
  EXPECT_EQ(log.motor_position[0][0], 5);
  EXPECT_EQ(log.motor_position[1][0], 2) << "by its own name";
}

TEST_F(ArmLog, EntriesReplaceThoseOfTheModel) {
  const Log log = read_log_of(model_, path_, {"motor_position_1=turns,scale=2", "motor_position_2=note"});
  EXPECT_EQ(log.motor_position[0][0], 1);
  EXPECT_EQ(log.motor_position[1][0], 7);
}

TEST_F(ArmLog, NamesColumnsThatAreNotUsed) {
  EXPECT_EQ(ignored_columns_note(read_log_of(model_, path_)),
            "note: " + path_.string() + ": columns that are not used: motor_position_1, note");
  EXPECT_EQ(ignored_columns_note(Log(3)), "");
}

TEST_F(ArmLog, OfMoreMotorsMayBeThatOfAnotherArm) {
  std::ofstream(path_) << "time,turns,motor_position_2,motor_position_3,motor_position_4\n0,1,2,3,4\n0.001,1,2,3,4\n";
  EXPECT_EQ(ignored_columns_note(read_log_of(model_, path_, {}, /*torque_required=*/false)),
            "note: " + path_.string() +
                ": columns that are not used: motor_position_4; the model has 3 joints: this may be the log of another "
                "arm");
}

TEST_F(ArmLog, NeedsAMotorTorqueOnlyIfAsked) {
  std::ofstream(path_) << "time,motor_position_1,motor_position_2,motor_position_3,turns\n0,1,2,3,0\n0.001,1,2,3,0\n";
  EXPECT_NE(message_of([&] { read_log_of(model_, path_); }).find("motor_torque_1"), std::string::npos);
  const Log log = read_log_of(model_, path_, {}, /*torque_required=*/false);
  EXPECT_EQ(log.size(), 2u);
  EXPECT_EQ(missing_torques_note(log, model_),
            "note: " + path_.string() +
                ": has no motor_torque_1, motor_torque_2, motor_torque_3: nothing is "
                "compared with the torques of these motors");
}

}  // namespace
}  // namespace halyard
