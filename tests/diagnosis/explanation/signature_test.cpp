/// The sentence about a residual that no effect explains.

#include "diagnosis/explanation/signature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "diagnosis/explanation/residual_signals.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

TEST(Signature, TellsTheRootMeanSquareOfAResidualOverWhatItsSensorResolves) {
  const ArmModel model = first_joints(1);
  Log log = simulate(motion(model, 4)).measured;
  for (double& q : log.joint_position[0]) q += 0.5;  // rad: thousands of what the sensor resolves
  const Evidence evidence(make_records(log, model, {}), model);
  const Hypothesis h{model.nominal, {}};
  std::vector<FullPrediction> predictions;
  for (const Record& r : evidence.records()) predictions.push_back(predict_fully(r, h));
  double square = 0, count = 0;
  const ResidualSignals signals = residual_signals(evidence.records(), predictions, h, 0);
  for (const double e : signals.of(ResidualKind::joint_position))
    if (std::isfinite(e)) square += e * e, count += 1;
  char ratio[64];
  std::snprintf(ratio, sizeof ratio, "is %.1f times what its sensor resolves",
                std::sqrt(square / count) / evidence.floor()[1]);
  const std::string told = signature(evidence, h, 0);
  EXPECT_NE(told.find(ratio), std::string::npos) << told << "\n" << ratio;
  EXPECT_NE(told.find(" RMS, "), std::string::npos) << told;
}

TEST(Signature, OfARightModelIsEmpty) {
  const ArmModel model = first_joints(1);
  const Evidence evidence(make_records(simulate(motion(model, 4)).measured, model, {}), model);
  EXPECT_EQ(signature(evidence, {model.nominal, {}}, 0), "");
}

}  // namespace
}  // namespace halyard
