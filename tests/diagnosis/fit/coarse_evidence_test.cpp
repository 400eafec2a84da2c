#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/fit/evidence.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

/// Two joints, whose log has a sensor reading every so many rows.
Evidence recorded(const ArmModel& model, std::size_t rows_a_reading) {
  Log log = simulate(motion(model, 5)).measured;
  for (std::vector<double>& readings : log.joint_position)
    for (std::size_t i = 0; i < readings.size(); ++i)
      if (i % rows_a_reading != 0) readings[i] = std::nan("");
  return Evidence(make_records(log, model, {}), model);
}

double rms(const std::vector<double>& a, const std::vector<double>& b) {
  double square = 0;
  for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(square / static_cast<double>(a.size()));
}

/// So many rows of the log to a reading of the joints.
class CoarseEvidence : public testing::TestWithParam<std::size_t> {};

TEST_P(CoarseEvidence, HasTheSameRowsAndIsExactAtItsBase) {
  const ArmModel model = first_joints(2);
  const Evidence evidence = recorded(model, GetParam());
  const Hypothesis base{model.nominal, {place_effect(*find_effect("hysteresis"), model.nominal, 1)}};
  const auto coarse = evidence.coarse_around(base);
  ASSERT_TRUE(coarse);
  EXPECT_LT(coarse->records()[0].size, evidence.records()[0].size);
  EXPECT_LT(rms(coarse->fit_rows({base})[0], evidence.fit_rows({base})[0]), 1e-12);
  EXPECT_LT(rms(coarse->score(base).deciding, evidence.score(base).deciding), 1e-12);
}

TEST_P(CoarseEvidence, FollowsAChange) {
  const ArmModel model = first_joints(2);
  const Evidence evidence = recorded(model, GetParam());
  const Hypothesis base{model.nominal, {}};
  const auto coarse = evidence.coarse_around(base);
  // A joint in its gap bounces, and is therefore followed less well.
  const std::pair<const char*, double> error_of[] = {
      {"stiffness", 0.05}, {"motor_friction", 0.05}, {"cable_slip", 0.05}, {"backlash", 0.25}};
  for (const auto& [name, error] : error_of) {
    const Hypothesis changed{model.nominal, {place_effect(*find_effect(name), model.nominal, 1)}};
    const std::vector<double> of_fine = evidence.fit_rows({changed})[0], of_coarse = coarse->fit_rows({changed})[0];
    EXPECT_LT(rms(of_coarse, of_fine), error * rms(of_fine, evidence.fit_rows({base})[0])) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(RowsAReading, CoarseEvidence, testing::Values(1, 10));

TEST(CoarseEvidence, IsNoneWhereTheGridErrsTooMuch) {
  const ArmModel model = first_joints(2);
  const Evidence evidence = recorded(model, 1);
  const Hypothesis base{model.nominal, {}};
  std::vector<double> most(4, 1);
  EXPECT_TRUE(evidence.coarse_around(base, most));
  most[3] = 1e-12;  // m: no grid is as good
  EXPECT_FALSE(evidence.coarse_around(base, most));
}

TEST(CoarseEvidence, IsThereForRecordsWhoseStepsDifferByRounding) {
  const ArmModel model = first_joints(2);
  const Evidence one = recorded(model, 1);
  std::vector<Record> records = {one.records()[0], one.records()[0]};
  records[1].dt *= 1 + 1e-12;
  EXPECT_TRUE(Evidence(records, model).coarse_around({model.nominal, {}}));
  records[1].dt *= 1.1;
  EXPECT_FALSE(Evidence(records, model).coarse_around({model.nominal, {}}));
}

TEST(CoarseEvidence, OfABaseThatCannotBeIntegratedIsNone) {
  const ArmModel model = first_joints(1);
  Hypothesis impossible{model.nominal, {}};
  impossible.nominal.joint[0].mass = std::nan("");
  EXPECT_FALSE(recorded(model, 1).coarse_around(impossible));
}

}  // namespace
}  // namespace halyard
