/// A fit says what it came to in its result, and writes nothing.

#include "diagnosis/fit/fit.h"

#include <glog/logging.h>
#include <gtest/gtest.h>

#include <limits>

#include "diagnosis/diagnose.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

TEST(Fit, LeavesTheLogOfTheProgramAlone) {
  const ArmModel model = first_joints(1);
  const Evidence evidence(make_records(simulate(motion(model, 2)).measured, model, {}), model);
  Hypothesis right{model.nominal, {place_effect(*find_effect("stiffness"), model.nominal, 0)}};
  const auto fit_from = [&](const Hypothesis& start) {
    return fit(evidence, start, effect_parameters(evidence, right, model.nominal, 0),
               channel_scale(evidence, std::vector<double>(evidence.channels(), 0)));
  };
  Hypothesis impossible = right;
  impossible.nominal.joint[0].mass = std::numeric_limits<double>::quiet_NaN();

  const int level = FLAGS_minloglevel;
  ASSERT_LT(level, google::GLOG_ERROR);
  ::testing::internal::CaptureStderr();
  EXPECT_TRUE(fit_from(right).usable);
  EXPECT_FALSE(fit_from(impossible).usable) << "its motion cannot be integrated";
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(FLAGS_minloglevel, level);
}

}  // namespace
}  // namespace halyard
