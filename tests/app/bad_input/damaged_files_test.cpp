// Files with bytes that are changed, lost or doubled: the program says so, or goes on; it does not crash.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support/program_run.h"

namespace halyard::testing_program {
namespace {

class DamagedFiles : public ProgramTest {};

TEST_F(DamagedFiles, EndTheProgramByNoSignal) {
  const std::string log =
      "time,motor_torque_1,motor_torque_2,motor_torque_3,motor_position_1,motor_position_2,motor_position_3\n"
      "0,0,0,0,107,204,904\n0.001,0,0,0,107,204,904\n0.002,0,0,0,107,204,904\n";
  std::mt19937 random(1);  // same damages in every run
  const auto damaged = [&](std::string text) {
    const std::size_t at = random() % text.size();
    switch (random() % 4) {
      case 0: text[at] = static_cast<char>(random() % 256); break;
      case 1: text.erase(at, random() % 40); break;
      case 2: text.insert(at, text.substr(random() % text.size(), random() % 40)); break;
      case 3: text[at] = "0-e.\"<>,\n"[random() % 9]; break;
    }
    return text;
  };
  const std::string model = text_of(example("raven2.xml")), sweep = text_of(example("tension_sweep.xml"));
  write_short_scenario("experiment_a_exponential.xml");
  int refused = 0;
  for (int i = 0; i < 100; ++i) {
    write_text(path("damaged.xml"), damaged(i % 2 ? model : sweep));
    write_text(path("damaged.csv"), damaged(log));
    for (const auto& result :
         {run({"check", "damaged.xml"}), run({"estimate", "--model", "raven2.xml", "--estimator", "kinematics",
                                              "--data", "damaged.csv", "--out", "e.csv"})}) {
      EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 2) << result.exit_code << " " << result.err;
      EXPECT_EQ(std::ranges::count(result.err, '\n'), result.exit_code == 0 ? 0 : 1) << result.err;
      if (result.exit_code == 2) ++refused;
    }
  }
  // Observed 164 of 200: the damage reaches what is read, and does not stop at the first line of it.
  RecordProperty("refused", refused);
  EXPECT_GT(refused, 50);
  EXPECT_LT(refused, 190);
}

}  // namespace
}  // namespace halyard::testing_program
