// One part of a command fails while the others are computed beside it.
#include <gtest/gtest.h>

#include "tests/app/faults/faults.h"

namespace halyard::testing_program {
namespace {

TEST_F(Faults, ATourTellsWhichInputOfAPartIsWrong) {
  const Arguments tour = slow_commands().back();
  const fs::path calibration = path("examples/raven2/calibration.xml");
  write_text(calibration, replaced(text_of(calibration), "duration=\"3.05\"", "duration=\"1\""));
  const RunResult result = run(tour);
  EXPECT_EQ(result.exit_code, 2);
  expect_line(result.err, "calibration.xml: 1 s of it are for the estimation");
  EXPECT_FALSE(fs::exists(path("out")));
}

}  // namespace
}  // namespace halyard::testing_program
