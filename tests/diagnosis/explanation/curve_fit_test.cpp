/// Curves through samples: exact where the signal is one, and no better than chance where there is none.

#include "diagnosis/explanation/curve_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/limits.h"

namespace halyard {
namespace {

TEST(CurveFit, RecoversAPolygonWithCornersAtItsKnots) {
  // 101 samples: three knots are the ends and the middle.
  std::vector<double> x, y;
  for (int i = 0; i <= 100; ++i) x.push_back(0.01 * i), y.push_back(std::abs(x.back() - 0.5));
  const CurveFit fit = fit_curve(x, y, {}, 3, 0);
  ASSERT_EQ(fit.curves.size(), 1u);
  EXPECT_EQ(fit.curves[0].x, (std::vector<double>{0, 0.5, 1}));
  // The ridge of 1e-12 a sample moves values by about as much.
  EXPECT_NEAR(fit.curves[0].y[0], 0.5, 1e-10);
  EXPECT_NEAR(fit.curves[0].y[1], 0, 1e-10);
  EXPECT_NEAR(fit.curves[0].y[2], 0.5, 1e-10);
  EXPECT_NEAR(fit.explained, 1, 1e-10);
  EXPECT_NEAR(fit.swing(), 0.5, 1e-10);
  EXPECT_EQ(fit.numbers, 3);
}

TEST(CurveFit, TakesACurveForEachDirectionOfMotion) {
  std::vector<double> x, y, direction;
  for (int i = 0; i < 200; ++i) {
    direction.push_back(i % 2 == 0 ? 1 : -1);
    x.push_back(0.005 * i);
    y.push_back(x.back() + 2 * direction.back());  // as Coulomb friction of 2
  }
  const CurveFit one = fit_curve(x, y, {}, 4, 0), two = fit_curve(x, y, direction, 4, 0);
  ASSERT_EQ(two.curves.size(), 2u);
  EXPECT_NEAR(two.explained, 1, 1e-10);
  // One curve explains the slope alone: variance 1/12 of 1/12 + 4.
  EXPECT_NEAR(one.explained, (1.0 / 12) / (1.0 / 12 + 4), 0.01);
  for (const Curve& c : two.curves)
    for (std::size_t k = 0; k < c.x.size(); ++k) EXPECT_NEAR(c.y[k], c.x[k] + 2 * c.direction, 1e-9);
}

TEST(CurveFit, ClosesOverAPeriod) {
  // A triangle wave over an angle, with corners at multiples of a quarter turn: one lies at the seam.
  std::vector<double> x, y;
  for (int i = 0; i < 400; ++i) {
    x.push_back(0.01 * i);
    y.push_back(std::abs(x.back() - 2));
  }
  const CurveFit fit = fit_curve(x, y, {}, 4, 4);
  ASSERT_EQ(fit.curves.size(), 1u);
  EXPECT_NEAR(fit.explained, 1, 1e-10);
  EXPECT_EQ(fit.numbers, 4);
  EXPECT_NEAR(fit.curves[0].y[0], 2, 1e-9);
  EXPECT_NEAR(fit.curves[0].y[2], 0, 1e-9);
}

TEST(CurveFit, LeavesOutWhatIsNotFinite) {
  std::vector<double> x, y;
  for (int i = 0; i <= 50; ++i) x.push_back(i), y.push_back(3.0 * i);
  const CurveFit whole = fit_curve(x, y, {}, 3, 0);
  x.insert(x.begin() + 7, {kNan, 4.5}), y.insert(y.begin() + 7, {1e3, kNan});
  const CurveFit holed = fit_curve(x, y, {}, 3, 0);
  EXPECT_EQ(holed.curves[0].x, whole.curves[0].x);
  EXPECT_EQ(holed.curves[0].y, whole.curves[0].y);
}

TEST(CurveFit, ExplainsOfNoiseNoMoreThanItsNumbersTake) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  constexpr int kTrials = 400, kSamples = 200, kKnots = 9;
  double sum = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> x, y;
    for (int i = 0; i < kSamples; ++i) x.push_back(i), y.push_back(normal(random));
    sum += fit_curve(x, y, {}, kKnots, 0).explained;
  }
  // R² of noise is Beta((B - 1)/2, (N - B)/2): mean (B - 1)/(N - 1), and four standard errors of 400 means.
  const double a = 0.5 * (kKnots - 1), b = 0.5 * (kSamples - kKnots);
  const double deviation = std::sqrt(a * b / (a + b + 1)) / (a + b);
  EXPECT_NEAR(sum / kTrials, a / (a + b), 4 * deviation / std::sqrt(kTrials));
}

TEST(CurveFit, IsEmptyWithoutSamplesOrScatter) {
  EXPECT_TRUE(fit_curve({}, {}, {}, 3, 0).curves.empty());
  EXPECT_TRUE(fit_curve({1, 2, 3}, {5, 5, 5}, {}, 3, 0).curves.empty());
  EXPECT_TRUE(fit_curve({2, 2, 2}, {1, 2, 3}, {}, 3, 0).curves.empty());
  EXPECT_EQ(fit_curve({}, {}, {}, 3, 0).swing(), 0);
}

TEST(CurveFit, ACurveOfADirectionReachesAsFarAsItsSamples) {
  std::vector<double> x, y, direction;
  for (int i = 0; i <= 20; ++i) {
    x.push_back(0.1 * i), y.push_back(3 * x.back());
    direction.push_back(i <= 10 ? 1 : -1);
  }
  // Knots are at both ends and in the middle, where the motion reverses.
  const CurveFit fit = fit_curve(x, y, direction, 3, 0);
  ASSERT_EQ(fit.curves.size(), 2u);
  EXPECT_EQ(fit.curves[0].direction, -1);
  EXPECT_EQ(fit.curves[0].x, (std::vector<double>{x[10], x[20]}));
  EXPECT_EQ(fit.curves[1].x, (std::vector<double>{x[0], x[10]}));
  EXPECT_EQ(fit.numbers, 4);
}

TEST(CurveFit, AMotionInOneDirectionHasOneCurve) {
  const CurveFit fit = fit_curve({0, 1, 2, 3}, {0, 2, 4, 6}, {1, 1, 1, 1}, 2, 0);
  ASSERT_EQ(fit.curves.size(), 1u);
  EXPECT_EQ(fit.curves[0].direction, 1);
  EXPECT_EQ(fit.numbers, 2);
}

}  // namespace
}  // namespace halyard
