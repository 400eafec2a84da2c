#include "diagnosis/plan.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "diagnosis/diagnose.h"
#include "diagnosis/fit/baseline_reach.h"
#include "diagnosis/search/attribution.h"
#include "model/input_error.h"
#include "model/model_file.h"
#include "plant/simulate.h"
#include "tests/support/program_run.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

PlacedEffect placed(const std::string& name, const ArmModel& model, int joint) {
  return place_effect(*find_effect(name), model.nominal, joint);
}

Log log_of(const Scenario& scenario) {
  Log log = simulate(scenario).measured;
  log.source = "test";
  return log;
}

TEST(BoundedMinimum, MeetsTheConditionsOfOne) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 50; ++trial) {
    const int n = 1 + trial % 12;
    const auto gaussian = [&](auto) { return normal(random); };
    const Eigen::MatrixXd J = Eigen::MatrixXd(n + 3, n).unaryExpr(gaussian);
    Eigen::MatrixXd A = J.transpose() * J;
    A.diagonal().array() += 0.01;
    const Eigen::VectorXd b = 3 * Eigen::VectorXd(n).unaryExpr(gaussian), upper = Eigen::VectorXd::Ones(n);
    const Eigen::VectorXd u = bounded_minimum(A, b, -upper, upper), g = A * u - b;
    for (int i = 0; i < n; ++i) {
      ASSERT_LE(std::abs(u(i)), 1);
      // A whole further step would gain less than 1e-9 of the cost, of order 10 to 1e3 here: a gradient below 1e-2.
      if (std::abs(u(i)) < 1) EXPECT_NEAR(g(i), 0, 1e-2) << trial;
      else EXPECT_LE(g(i) * u(i), 0) << trial << ": pulled inwards from its bound";
    }
  }
}

TEST(DetectionLimit, IsWhereADiagnosisBeginsToSee) {
  const ArmModel model = first_joints(2);
  const DetectionLimit found =
      separation(model, {log_of(motion(model, 8))}, placed("backlash", model, 1), placed("hysteresis", model, 1)).first;
  ASSERT_TRUE(found.excited);
  EXPECT_EQ(found.parameter, "half_gap");
  EXPECT_EQ(found.effect.p[0], found.limit);
  const auto verdict_at = [&](double factor) {
    ArmModel truth = model;
    truth.effects.push_back(found.effect);
    truth.effects[0].p[0] *= factor;
    DiagnosisOptions options;
    options.most_effects = 1;
    options.tell_not_excited = false;
    return diagnose(model, {log_of(motion(truth, 8))}, log_of(motion(truth, 3, 1)), options);
  };
  const Diagnosis above = verdict_at(3);
  ASSERT_EQ(above.effects.size(), 1u);
  EXPECT_EQ(above.effects[0].effect.effect->name(), "backlash");
  EXPECT_EQ(above.effects[0].effect.joint, 1);
  const Diagnosis below = verdict_at(0.2);
  EXPECT_EQ(below.verdict, Diagnosis::Verdict::clean);
}

TEST(DetectionLimit, NeedsALog) { EXPECT_THROW(detection_limits(first_joints(1), {}), InputError); }

TEST(DetectionLimit, IsTheShareOfAGivenEffectFromWhichItIsDetected) {
  const ArmModel model = first_joints(1);
  const Log log = log_of(motion(model, 8));
  PlacedEffect offset = placed("encoder_offset", model, 0);
  const DetectionLimit found = separation(model, {log}, offset, placed("backlash", model, 0)).first;
  ASSERT_TRUE(found.excited);
  PlacedEffect twice = found.effect, half = found.effect;
  twice.p[0] = found.neutral + 2 * (found.limit - found.neutral);
  half.p[0] = found.neutral + 0.5 * (found.limit - found.neutral);
  const std::vector<double> share = detected_from(model, {log}, {found.effect, twice, half});
  // Both are the smallest detected size to 9 %, on grids that need not coincide.
  EXPECT_NEAR(share[0], 1, 0.1);
  EXPECT_NEAR(share[1], 0.5, 0.1 * 0.5);
  EXPECT_TRUE(std::isinf(share[2]));
}

TEST(NamingLimit, OfABacklashUnderALoadIsWhereItsGapIsCrossed) {
  // Gravity keeps the cable on one side of a small gap, which then looks like an offset of the encoder.
  const ArmModel model = first_joints(2);
  const Log log = log_of(motion(model, 8));
  PlacedEffect small = placed("backlash", model, 1), large = small;
  small.p[0] = 2e-5, large.p[0] = 2e-3;
  EXPECT_LE(detected_from(model, {log}, {small})[0], 1);
  EXPECT_LE(named_from(model, {log}, large), 1);
}

TEST(NamingLimit, OfAnEccentricityIsInfiniteIfTheMotionHasTooFewPeriods) {
  const ArmModel model = first_joints(1);
  const Log log = log_of(motion(model, 8));
  PlacedEffect once_a_turn = placed("encoder_eccentricity", model, 0);
  once_a_turn.p[0] = once_a_turn.p[1] = 0.01, once_a_turn.p[2] = 1;
  PlacedEffect often = once_a_turn;
  often.p[2] = 32;
  EXPECT_LE(detected_from(model, {log}, {once_a_turn})[0], 1);
  EXPECT_TRUE(std::isinf(named_from(model, {log}, once_a_turn)));
  EXPECT_LE(named_from(model, {log}, often), 1);
}

TEST(DetectionLimit, GrowsWithTheSensorsResolution) {
  ArmModel fine = first_joints(1);
  ArmModel coarse = fine;
  coarse.nominal.joint[0].joint_encoder_resolution *= 10;
  const auto limit = [](const ArmModel& model) {
    const PlacedEffect offset = placed("encoder_offset", model, 0), gap = placed("backlash", model, 0);
    return separation(model, {log_of(motion(model, 6))}, offset, gap).first.limit;
  };
  // An offset moves one channel by its own size: the floor, ten times as high, is all that counts. Sizes are tried at
  // ratios of 2^(1/8); the rounding itself and what the baseline's numbers take of an offset change a little.
  EXPECT_NEAR(limit(coarse) / limit(fine), 10, 2);
}

TEST(Separation, OfFrictionsOfMotorAndJointAsksForAJointSensor) {
  const ArmModel model = first_joints(1);
  Log log = log_of(motion(model, 6));
  const PlacedEffect at_motor = placed("motor_friction", model, 0), at_joint = placed("joint_friction", model, 0);
  const Separation with = separation(model, {log}, at_motor, at_joint);
  EXPECT_TRUE(with.first.excited && with.second.excited);
  EXPECT_TRUE(with.told_apart);
  log.joint_position[0].clear();
  const Separation without = separation(model, {log}, at_motor, at_joint);
  EXPECT_TRUE(without.first.excited && without.second.excited);
  EXPECT_FALSE(without.told_apart);
  EXPECT_GT(without.cosine, with.cosine);
  EXPECT_GT(without.cosine, 0.9);
}

TEST(Separation, OfARatioAndAnOffsetAsksForMoreThanOnePosition) {
  const ArmModel model = first_joints(1);
  const auto between = [&](double amplitude) {
    Scenario s = motion(model, 6);
    s.trajectory[0].center += 0.4;  // at home the ratio would not show at all
    s.trajectory[0].sines = {{amplitude, 0.5, 0}, {amplitude / 2, 1.1, 0}};
    return separation(model, {log_of(s)}, placed("capstan_ratio", model, 0), placed("encoder_offset", model, 0));
  };
  const Separation narrow = between(0.002), wide = between(0.2);
  EXPECT_FALSE(narrow.told_apart);
  EXPECT_GT(narrow.cosine, 0.99);
  EXPECT_TRUE(wide.told_apart);
  EXPECT_LT(wide.cosine, narrow.cosine);
}

TEST(Separation, OfWhatCannotBeSeenIsNone) {
  const ArmModel model = first_joints(2);
  Scenario s = motion(model, 4);
  s.trajectory[0].kind = JointTrajectory::Kind::hold;
  Log log = log_of(s);
  for (auto& column : log.joint_position) column.clear();
  // Only the encoder of the joint has its error.
  const Separation none =
      separation(model, {log}, placed("encoder_eccentricity", model, 1), placed("motor_friction", model, 1));
  EXPECT_FALSE(none.first.excited);
  EXPECT_TRUE(none.second.excited);
  EXPECT_FALSE(none.told_apart);
  EXPECT_EQ(none.cosine, 1);
}

TEST(DetectionLimits, AreTheSameOnOneThreadAndOnTwo) {
  const ArmModel model = first_joints(1);
  const Log log = log_of(motion(model, 4));
  const auto on = [&](int threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return detection_limits(model, {log});
  };
  const auto one = on(1), two = on(2);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].limit, two[i].limit) << i;
    EXPECT_EQ(one[i].confused_with.size(), two[i].confused_with.size()) << i;
  }
}

TEST(NamesNothing, OneSine) {
  const ArmModel model = first_joints(1);
  Scenario s = motion(model, 6);
  EXPECT_FALSE(names_nothing(model, {log_of(s)}));
  s.trajectory[0].sines.resize(1);
  EXPECT_TRUE(names_nothing(model, {log_of(s)}));
}

class PlanCommand : public testing_program::ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    ArmModel model = first_joints(1);
    model.joints[0].controller.kp *= 4;
    model.joints[0].controller.kd *= 2;
    testing_program::write_text(path("arm.xml"), model_to_xml(model));
    testing_program::write_text(path("motion.xml"), scenario(""));
  }
  static std::string scenario(const std::string& effects) {
    return "<scenario name=\"one position\" model=\"arm.xml\" duration=\"3\">" + effects +
           "<trajectory joint=\"1\" kind=\"sines\" center=\"1.2\"><sine amplitude=\"0.002\" frequency=\"0.5\"/>"
           "</trajectory></scenario>";
  }
};

TEST_F(PlanCommand, TellsLimitsAndProposesAMotionThatSeparates) {
  const std::string out = done({"diagnose", "--plan", "arm.xml", "motion.xml", "--separate",
                                "capstan_ratio@1,encoder_offset@1", "--out", "plan"});
  EXPECT_TRUE(testing_program::contains(out, "moves along one sine")) << out;
  EXPECT_TRUE(testing_program::contains(out, "given motion")) << out;
  EXPECT_TRUE(testing_program::contains(out, "proposed motion")) << out;
  const auto files = testing_program::files_in(path("plan"));
  ASSERT_EQ(files.size(), 3u);
  EXPECT_TRUE(testing_program::contains(files.at("plan.html"), "capstan_ratio"));
  const auto json = nlohmann::json::parse(files.at("plan.json"));
  const ArmModel model = read_model(path("arm.xml"));
  EXPECT_EQ(json.at("limits").size(), all_candidates(model.nominal).size());
  const auto& given = json.at("separation").at("given");
  const auto& proposed = json.at("separation").at("proposed");
  EXPECT_FALSE(given.at("told_apart").get<bool>());
  EXPECT_TRUE(proposed.at("told_apart").get<bool>());
  EXPECT_LT(proposed.at("cosine"), given.at("cosine"));

  // The file is the motion that was judged, and a robot can make it.
  done({"check", "plan/scenario.xml"});
  const Scenario scenario = read_scenario(path("plan/scenario.xml"));
  const Separation again =
      separation(model, {log_of(scenario)}, placed("capstan_ratio", model, 0), placed("encoder_offset", model, 0));
  // Four digits are written.
  EXPECT_NEAR(again.cosine, proposed.at("cosine").get<double>(), 1e-4);
}

TEST_F(PlanCommand, TakesTheProposalOfAnEarlierPlanAway) {
  std::filesystem::create_directory(path("plan"));
  for (const char* file : {"plan/plan.json", "plan/scenario.xml"}) testing_program::write_text(path(file), "earlier");
  done({"diagnose", "--plan", "arm.xml", "motion.xml", "--out", "plan"});
  const auto files = testing_program::files_in(path("plan"));
  EXPECT_EQ(files.size(), 2u);
  EXPECT_FALSE(files.contains("scenario.xml"));
}

TEST_F(PlanCommand, TakesTheScenariosEffectsOutAndSaysSo) {
  testing_program::write_text(path("worn.xml"), scenario("<effects><effect name=\"backlash\" joint=\"1\"/></effects>"));
  const std::string clean = done({"diagnose", "--plan", "arm.xml", "motion.xml"});
  const std::string worn = done({"diagnose", "--plan", "arm.xml", "worn.xml"});
  EXPECT_TRUE(worn.starts_with("note: ")) << worn;
  EXPECT_TRUE(testing_program::contains(testing_program::lines_of(worn)[0], "backlash of joint 1")) << worn;
  EXPECT_EQ(worn.substr(worn.find('\n') + 1), clean) << "the same arm moves";
}

TEST_F(PlanCommand, WritesItsResultWhateverBytesANameHas) {
  std::filesystem::copy_file(path("arm.xml"), path("f\xe9"
                                                   "d\xe9.xml"));  // Latin-1, which is no UTF-8
  done({"diagnose", "--plan",
        "f\xe9"
        "d\xe9.xml",
        "motion.xml", "--out", "plan"});
  EXPECT_TRUE(nlohmann::json::parse(testing_program::text_of(path("plan/plan.json"))).contains("limits"));
}

TEST_F(PlanCommand, RefusesBadInputInOneLine) {
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& says) {
    std::vector<std::string> all = {"diagnose"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const testing_program::RunResult r = run(all);
    EXPECT_EQ(r.exit_code, 2) << says;
    EXPECT_EQ(testing_program::lines_of(r.err).size(), 1u) << r.err;
    EXPECT_TRUE(testing_program::contains(r.err, says)) << r.err;
    EXPECT_FALSE(std::filesystem::exists(path("plan")));
  };
  const std::vector<std::string> plan = {"--plan", "arm.xml", "motion.xml", "--out", "plan", "--separate"};
  const auto separate = [&](const std::string& pair) {
    std::vector<std::string> all = plan;
    all.push_back(pair);
    return all;
  };
  refused(separate("backlash@1"), "expected two effects");
  refused(separate("backlash@1,wear@1"), "no such effect");
  refused(separate("backlash@1,hysteresis@x"), "expected EFFECT@JOINT");
  refused(separate("backlash@1,hysteresis@2"), "cannot be at joint 2");
  refused(separate("backlash@1,backlash@1"), "names one effect twice");
  refused({"--plan", "arm.xml"}, "--plan");
  refused({"--plan", "arm.xml", "none.xml"}, "none.xml");
  refused({"--plan", "arm.xml", "motion.xml", "--data", "x.csv"}, "excludes");
  refused({"--plan", example("raven2.xml"), "motion.xml"}, "moves 1 joints");
  refused({"--separate", "backlash@1,hysteresis@1"}, "--plan");
  refused({"--model", "arm.xml", "--out", "plan"}, "--data is required");
}

}  // namespace
}  // namespace halyard
