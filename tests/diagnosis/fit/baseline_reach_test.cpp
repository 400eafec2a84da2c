/// What numbers of the model take of a change of the residual, in closed form.

#include "diagnosis/fit/baseline_reach.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/small_evidence.h"

namespace halyard {
namespace {

/// One number of the model that moves only the last row: by 2 in the reach's weights.
struct OneNumberReach {
  const Evidence& evidence;
  const Eigen::Index rows = std::ssize(evidence.row_channel());
  const double scale = 3, weight = 1 / (scale * std::sqrt(evidence.correlated_rows(evidence.row_channel().back())));
  BaselineReach reach{evidence, {moved()}, std::vector<double>(evidence.channels(), scale)};

  explicit OneNumberReach(const Evidence& of = once()) : evidence(of) {}
  static const Evidence& once() {
    static const Evidence evidence = brief_evidence();
    return evidence;
  }
  std::vector<double> moved() const {
    std::vector<double> column(static_cast<std::size_t>(rows), 0);
    column.back() = 2 / weight;
    return column;
  }
  /// A weighted change of the first and the last row.
  Eigen::VectorXd change(double first, double last) const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(rows);
    x(0) = first, x(rows - 1) = last;
    return x;
  }
};

TEST(BaselineReach, TakesWhatThePenalisedNumberExplains) {
  const OneNumberReach one;
  const BaselineReach::Taken t = one.reach.take(one.change(7, 2));
  // |2 - 2 u|² + u² is least at u = 4 / 5.
  EXPECT_NEAR(t.left(0), 7, 1e-12);
  EXPECT_NEAR(t.left(one.rows - 1), 0.4, 1e-9);
  EXPECT_NEAR(t.cost, 49 + 0.8, 1e-9);
}

TEST(BaselineReach, TakesNoMoreThanTheWholeToleranceGives) {
  const OneNumberReach one;
  for (const double sign : {-1, 1}) {
    const BaselineReach::Taken t = one.reach.take(one.change(0, sign * 10));
    EXPECT_DOUBLE_EQ(t.left(one.rows - 1), sign * (10 - 2 * 2));
    EXPECT_DOUBLE_EQ(t.cost, 36 + 4);
  }
}

TEST(BaselineReach, TakesTheSizesOfAnEffectWithoutPenaltyWithinTheirBounds) {
  const OneNumberReach one;
  const auto of_first_row =
      one.reach.sizes(one.change(0.5, 0), Eigen::VectorXd::Constant(1, -1), Eigen::VectorXd::Constant(1, 3));
  const BaselineReach::Taken inside = one.reach.take(one.change(1, 2), of_first_row),
                             beyond = one.reach.take(one.change(-4, 0), of_first_row);
  EXPECT_NEAR(inside.amount(0), 2, 1e-8);
  EXPECT_NEAR(inside.left(0), 0, 1e-8);
  EXPECT_NEAR(inside.left(one.rows - 1), 0.4, 1e-8) << "the number of the model takes its part as well";
  EXPECT_DOUBLE_EQ(beyond.amount(0), -1);
  EXPECT_DOUBLE_EQ(beyond.left(0), -3.5);
  EXPECT_DOUBLE_EQ(beyond.cost, 3.5 * 3.5);
}

TEST(BaselineReach, WeighsEachRowByItsChannelsScaleAndBack) {
  const OneNumberReach one;
  const std::vector<double> ones(static_cast<std::size_t>(one.rows), 1.0);
  const Eigen::VectorXd weighted = one.reach.weighted(ones);
  for (const double w : weighted) EXPECT_DOUBLE_EQ(w, one.weight);
  for (const double x : one.reach.rows(weighted)) EXPECT_DOUBLE_EQ(x, 1);
}

TEST(BaselineReach, NarrowsANumberByTheDeterminantOfItsInformation) {
  EXPECT_NEAR(OneNumberReach().reach.half_log_det(), 0.5 * std::log(5), 1e-12);
}

TEST(BoundedMinimum, LeavesABoundAgainWhereTheOtherNumberIsHeld) {
  // Without bounds the minimum is (10.5, -9.5). At its nearest corner the second number is pulled back.
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(2);
  const Eigen::VectorXd u = bounded_minimum(Eigen::Matrix2d{{1, 0.9}, {0.9, 1}}, Eigen::Vector2d(2, 0), -one, one);
  EXPECT_EQ(u(0), 1);
  EXPECT_NEAR(u(1), -0.9, 1e-4);
}

}  // namespace
}  // namespace halyard
