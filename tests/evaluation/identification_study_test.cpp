#include "evaluation/studies/identification_study.h"

#include <gtest/gtest.h>

#include <utility>

namespace halyard {
namespace {

EstimatorErrors errors_with(std::vector<double> rms) {
  EstimatorErrors errors;
  errors.rms = std::move(rms);
  return errors;
}

/// A study of an arm with two joints, whose sr_ukf has these RMS errors with the given and the identified model.
IdentificationStudy study_of(std::vector<double> before, std::vector<double> after) {
  IdentificationStudy study;
  study.given.nominal.n = 2;
  study.identification.converged = true;
  study.estimators = {{"kinematics", errors_with({1, 1}), errors_with({9, 9})},
                      {"sr_ukf", errors_with(std::move(before)), errors_with(std::move(after))}};
  return study;
}

TEST(IdentificationStudy, AdoptsNumbersThatDoNotMakeTheFilterWorse) {
  const IdentificationStudy better = study_of({1, 1}, {0.5, 1.05});
  EXPECT_TRUE(adopted(better)) << "an error that grows by less than a tenth has not grown";
  EXPECT_TRUE(doubts(better).empty());
}

TEST(IdentificationStudy, WeighsAJointThatIsWorseAgainstThoseThatAreBetter) {
  const IdentificationStudy better = study_of({1, 1}, {0.4, 2});  // 0.4 * 2 < 1
  EXPECT_TRUE(adopted(better));
  ASSERT_EQ(doubts(better).size(), 1u);
  EXPECT_NE(doubts(better)[0].find("not better at all joints of the hold-out (joint 2 by 2 times)"), std::string::npos);
  const IdentificationStudy worse = study_of({1, 1}, {0.6, 2});
  EXPECT_FALSE(adopted(worse));
  ASSERT_EQ(doubts(worse).size(), 1u);
  EXPECT_NE(doubts(worse)[0].find("is worse on the hold-out (joint 2 by 2 times)"), std::string::npos);
}

TEST(IdentificationStudy, DoesNotAdoptNumbersThatTheFilterFailsWith) {
  IdentificationStudy fails = study_of({1, 1}, {});
  fails.estimators[1].after.failure = "diverged at 0.3 s";
  EXPECT_FALSE(adopted(fails));
  ASSERT_EQ(doubts(fails).size(), 1u);
  EXPECT_NE(doubts(fails)[0].find("fails: diverged at 0.3 s"), std::string::npos);
}

TEST(IdentificationStudy, NamesNumbersThatDeviateAndAnEstimateThatMoves) {
  IdentificationStudy study = study_of({1, 1}, {1, 1});
  study.identification.deviating = {{"joint 1 cable stiffness", "N/m", 7e5, 9e5, 2.9}};
  study.identification.converged = false;
  ASSERT_EQ(doubts(study).size(), 2u);
  EXPECT_NE(doubts(study)[0].find("joint 1 cable stiffness (9e+05 instead of 7e+05 N/m)"), std::string::npos);
  EXPECT_NE(doubts(study)[1].find("still moves"), std::string::npos);
}

TEST(IdentificationStudy, NamesAFilterThatEndedEarlyOrWasSurprised) {
  IdentificationStudy study = study_of({1, 1}, {1, 1});
  study.identification.innovation_size = 2;
  EXPECT_TRUE(doubts(study).empty());
  study.identification.innovation_size = 17.3;
  study.identification.filter_failure = "diverged at 0.3 s";
  ASSERT_EQ(doubts(study).size(), 2u);
  EXPECT_NE(doubts(study)[0].find("ended early (diverged at 0.3 s)"), std::string::npos);
  EXPECT_NE(doubts(study)[1].find("17 times what its noise explains"), std::string::npos);
}

TEST(IdentificationStudy, ANumberWithoutUnitIsShownWithoutOne) {
  IdentificationStudy study = study_of({1, 1}, {1, 1});
  study.identification.deviating = {{"joint 1 motor torque scale", "1", 1, 0.95, -2.5}};
  ASSERT_EQ(doubts(study).size(), 1u);
  EXPECT_NE(doubts(study)[0].find("(0.95 instead of 1)"), std::string::npos);
}

}  // namespace
}  // namespace halyard
