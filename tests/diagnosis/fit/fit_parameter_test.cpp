#include "diagnosis/fit/fit_parameter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "plant/simulate.h"
#include "tests/support/short_arm.h"
#include "tests/support/small_evidence.h"

namespace halyard {
namespace {

TEST(FitParameter, AWholeNumberHasWholeBounds) {
  const Evidence evidence = small_evidence();
  const ArmModel model = first_joints(2);
  for (const char* name : {"torque_ripple", "capstan_eccentricity"}) {
    const Hypothesis h{model.nominal, {place_effect(*find_effect(name), model.nominal, 1)}};
    const std::vector<FitParameter> all = effect_parameters(evidence, h, model.nominal, 0);
    for (const FitParameter& p : all) {
      if (!p.is_whole) continue;
      EXPECT_EQ(p.lower, std::round(p.lower)) << name;
      EXPECT_EQ(p.upper, std::round(p.upper)) << name;
      EXPECT_LE(p.lower, p.starts.front()) << name;
      EXPECT_FALSE(ends_at_bound(p, p.lower)) << name << ": the lowest order that the motion shows is plausible";
    }
  }
}

/// The log of a motor's torque may be a current.
TEST(FitParameter, TheFloorOfATorqueIsInTheUnitOfTheLog) {
  constexpr double kScale = 0.02;  // N m per A
  const ArmModel given = first_joints(2);
  ArmModel model = given;
  Log log = simulate(motion(given, 6)).measured;
  const Evidence in_newton_metres(make_records(log, given, {}), given);
  for (double& torque : log.motor_torque[0]) torque /= kScale;
  model.nominal.joint[0].torque_scale = kScale;
  const Evidence in_amperes(make_records(log, model, {}), model);
  EXPECT_NEAR(in_amperes.resolved()[0] / in_newton_metres.resolved()[0], 1 / kScale, 1e-6 / kScale);
  const auto rms = [](const Evidence& evidence, const ArmModel& arm) {
    return std::sqrt(evidence.score({arm.nominal, {}}).mean_square[0]);
  };
  EXPECT_NEAR(rms(in_amperes, model) / rms(in_newton_metres, given), 1 / kScale, 1e-3 / kScale)
      << "and so is the residual";
}

}  // namespace
}  // namespace halyard
