#include <gtest/gtest.h>

#include <limits>

#include "bench/diagnosis/summary/acceptance.h"
#include "bench/diagnosis/summary/calibration.h"
#include "bench/diagnosis/summary/listed_parameter.h"
#include "tests/bench/trials.h"

namespace halyard::blind {
namespace {

void expect_share(const Proportion& share, int hits, int of) {
  EXPECT_EQ(share.hits, hits);
  EXPECT_EQ(share.of, of);
}

/// A stiffness of joint 1 with these true parameters, and what the diagnosis found.
Result stiffness(std::vector<TrueParameter> truth, std::vector<Parameter> found) {
  return trial(Kind::effect, {true_effect("stiffness", 1, std::move(truth))},
               {named("stiffness", 1, 0.99, {}, std::move(found))});
}

TEST(IntervalsOfTrials, CountOverTheParametersOfRightNames) {
  const Parameter found{"stiffness_ratio", 0.8, 0.7, 0.9};
  const Result inside = stiffness({{"stiffness_ratio", 0.75, true}}, {found}),
               outside = stiffness({{"stiffness_ratio", 0.95, true}}, {found});
  expect_share(parameter_counts({&inside, &outside}).intervals(), 1, 2);
  Result elsewhere = inside, other_form = inside, idle = inside;
  elsewhere.named[0].place.joint = 2;
  other_form.truth[0].form = "soft_cable";
  idle.truth[0].parameters[0].acts = false;
  expect_share(parameter_counts({&elsewhere, &other_form, &idle}).intervals(), 0, 0);
}

TEST(IntervalsOfTrials, AreAlsoThoseOfParametersThatWereReset) {
  const Result r =
      stiffness({{"stiffness_ratio", 0.75, true}, {"damping_ratio", 1.2, true}, {"stiffening", 5, true}},
                {{"stiffness_ratio", 0.8, 0.7, 0.9}, {"damping_ratio", 1, 0.7, 1.3}, {"stiffening", 0, 0, 4}});
  const ParameterCounts counts = parameter_counts({&r});
  expect_share(counts.kept, 1, 1);
  expect_share(counts.reset, 1, 2);
  expect_share(counts.intervals(), 2, 3);
}

TEST(IntervalsOfTrials, MissAParameterThatWasLeftOutAndIsNotNeutral) {
  // Neutral are a ratio of 1 and a stiffening of 0: here the ratio of the damping is off.
  const Result r = stiffness({{"stiffness_ratio", 0.75, true}, {"damping_ratio", 1.2, true}, {"stiffening", 0, true}},
                             {{"stiffness_ratio", 0.8, 0.7, 0.9}});
  const ParameterCounts counts = parameter_counts({&r});
  expect_share(counts.kept, 1, 1);
  expect_share(counts.off_neutral, 1, 2);
  expect_share(counts.intervals(), 1, 2);
  const std::string table = acceptance_table({&r});
  EXPECT_NE(table.find("were not reset to neutral | 92 to 98 % | 1/2 |"), std::string::npos) << table;
  EXPECT_NE(table.find("| parameters that were left out, but are not neutral |  | 1/2 |"), std::string::npos) << table;
}

TEST(IntervalsOfTrials, LeaveOutWholeNumbers) {
  const std::vector<TrueParameter> truth = {{"cosine", 0.002, true}, {"sine", 0.002, true}, {"order", 12, true}};
  const Result r =
      trial(Kind::effect, {true_effect("torque_ripple", 1, truth)},
            {named("torque_ripple", 1, 0.99, {},
                   {{"cosine", 0.002, 0.001, 0.003}, {"sine", 0.002, 0.001, 0.003}, {"order", 12, 12, 12}})});
  const ParameterCounts counts = parameter_counts({&r});
  expect_share(counts.kept, 2, 2);
  expect_share(counts.whole, 1, 1);
  Result next = r;
  next.named[0].parameters[2] = {"order", 13, 13, 13};
  expect_share(parameter_counts({&next}).whole, 0, 1);
  expect_share(parameter_counts({&next}).kept, 2, 2);
}

TEST(IntervalsOfTrials, KnowTheParametersOfTheLibrary) {
  EXPECT_EQ(listed_parameter("torque_scale", "scale").neutral, 1);
  EXPECT_EQ(listed_parameter("torque_scale", "bias").neutral, 0);
  EXPECT_TRUE(listed_parameter("torque_ripple", "order").is_whole);
  EXPECT_TRUE(listed_parameter("encoder_eccentricity", "order").is_whole);
  EXPECT_FALSE(listed_parameter("encoder_eccentricity", "wave_number").is_whole);
  EXPECT_TRUE(listed_parameter("encoder_offset", "at_joint").is_whole);
  // The RAVEN-II has no joint behind the third whose cable moves with joint 4.
  EXPECT_EQ(listed_parameter("coupling", "from_joint_4").neutral, 0);
  EXPECT_FALSE(listed_parameter("coupling", "from_joint_4").is_whole);
}

/// A clean trial in whose joints these shares of the hold-out lie in the intervals of the prediction.
Result with_coverage(std::vector<double> of_joints) {
  Result r = trial(Kind::clean, {}, {});
  r.interval_coverage = std::move(of_joints);
  return r;
}

TEST(IntervalsOfPredictions, AreCountedByTheMeanOverTheJointsOfATrial) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const Result old = trial(Kind::clean, {}, {}), none = with_coverage({kNone, kNone}),
               all = with_coverage({0.75, 1, 0.5}), some = with_coverage({kNone, 0.5, 0.75});
  EXPECT_EQ(interval_coverages({&old, &none, &all, &some}), (std::vector<double>{0.75, 0.625}));
}

TEST(IntervalsOfPredictions, HaveALineWithTheMedianAndTheLowestTenth) {
  std::vector<Result> ran;
  for (int i = 0; i <= 10; ++i) ran.push_back(with_coverage({0.5 + 0.05 * i}));
  ran.push_back(trial(Kind::clean, {}, {}));
  const std::string table = acceptance_table(pointers(ran));
  EXPECT_NE(table.find("| 5 | prediction intervals of 95 %: share of the samples within, mean over joints: median "
                       "0.750, 10 % below 0.550; 11 trials |"),
            std::string::npos)
      << table;
  EXPECT_EQ(acceptance_table({&ran.back()}).find("prediction intervals"), std::string::npos);
}

}  // namespace
}  // namespace halyard::blind
