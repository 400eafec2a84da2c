#include "diagnosis/starts/leaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plant/simulate.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

/// Residuals of the first two joints with a cable of the second that slips at an instant, without it in the model.
struct Slip {
  ArmModel model = first_joints(2);
  Evidence evidence;
  std::vector<double> rows;

  explicit Slip(double jump, double time)
      : evidence(make_records(simulate(motion(slipping(model, jump, time), 5)).measured, model, {}), model),
        rows(evidence.fit_rows({{model.nominal, {}}})[0]) {}

  static ArmModel slipping(ArmModel arm, double jump, double time) {
    PlacedEffect slip = place_effect(*find_effect("cable_slip"), arm.nominal, 1);
    slip.p[0] = jump, slip.p[1] = time;
    arm.effects.push_back(slip);
    return arm;
  }
};

TEST(Leaps, AreWhereACableSlips) {
  // Blocks last 0.25 s: in a fitting one, and in a deciding one, of which only the rows around it are seen.
  for (const double time : {2.613, 2.313}) {
    const Slip slip(2e-4, time);
    const std::vector<double> instants = leaps(slip.evidence, slip.rows);
    EXPECT_LE(instants.size(), 4 * 24u);
    EXPECT_TRUE(std::ranges::is_sorted(instants));
    EXPECT_NEAR(std::ranges::min(instants, {}, [&](double t) { return std::abs(t - time); }), time, 0.0101);
  }
}

TEST(Leaps, OfAResidualThatStandsStillAreNone) {
  const Slip slip(0, 2);
  EXPECT_TRUE(leaps(slip.evidence, std::vector<double>(slip.rows.size(), 1e-3)).empty());
}

TEST(Leaps, AreTheFourStrongestAlone) {
  const Evidence& evidence = made_evidence();
  const std::vector<double> sizes = {0.15, 0.6, 0.2, 0.5, 0.4, 0.3};
  // Each amid a fitting block of 0.25 s, between two rows.
  const auto time_of = [](std::size_t k) { return 0.63 + 0.5 * static_cast<double>(k); };
  std::vector<double> rows;
  for (std::size_t r = 0; r < evidence.row_channel().size(); ++r) {
    double x = r % 2 == 0 ? 0 : 1e-3;
    for (std::size_t k = 0; k < sizes.size(); ++k)
      if (evidence.row_time()[r] > time_of(k)) x += sizes[k];
    rows.push_back(evidence.row_channel()[r] == 1 ? x : 0);
  }
  const std::vector<double> instants = leaps(evidence, rows);
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const double time = time_of(k),
                 nearest = std::ranges::min(instants, {}, [&](double t) { return std::abs(t - time); });
    EXPECT_EQ(std::abs(nearest - time) < 0.0101, sizes[k] > 0.25) << sizes[k];
  }
}

}  // namespace
}  // namespace halyard
