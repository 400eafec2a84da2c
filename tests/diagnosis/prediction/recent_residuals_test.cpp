#include "diagnosis/prediction/recent_residuals.h"

#include <gtest/gtest.h>

#include "plant/simulate.h"
#include "tests/diagnosis/prediction/finite_numbers.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

class Recent : public testing::Test {
 protected:
  Hypothesis with_effect(const char* name) const {
    return {model_.nominal, {place_effect(*find_effect(name), model_.nominal, 1)}};
  }
  Hypothesis with_more_friction(double coulomb) const {
    Hypothesis h{model_.nominal, {}};
    h.nominal.joint[0].motor_coulomb = coulomb;  // changes the torque and no motion: it is replayed
    return h;
  }
  std::vector<std::vector<double>> predicted(const std::vector<Hypothesis>& all, RecentResiduals* recent) const {
    const auto of_request = predict({PredictionRequest{&record_, &all, kStride, recent}});
    std::vector<std::vector<double>> numbers;
    for (const Residuals& r : of_request[0]) numbers.push_back(finite_numbers(r));
    return numbers;
  }
  RecentResiduals::Key key(const Hypothesis& h, bool is_replayed = false) const {
    return {h, record_, kStride, scheme_for({}, record_.dt), is_replayed};
  }

  static constexpr int kStride = 10;
  static constexpr std::size_t kPlenty = 1 << 20;
  ArmModel model_ = first_joints(2);
  Record record_ = make_records(simulate(motion(model_, 2)).measured, model_, {})[0];
};

TEST_F(Recent, ResidualsAreThoseOfANewPrediction) {
  const Hypothesis plain{model_.nominal, {}};
  const std::vector<Hypothesis> all = {plain, with_more_friction(0.01), with_effect("backlash"), plain,
                                       with_more_friction(0.02)};
  const auto anew = predicted(all, nullptr);
  RecentResiduals recent(kPlenty);
  EXPECT_EQ(predicted({plain, with_more_friction(0.01)}, &recent), (std::vector{anew[0], anew[1]}));
  EXPECT_EQ(predicted(all, &recent), anew) << "known ones, unknown ones, twins, and replays of a known motion";
  EXPECT_EQ(predicted(all, &recent), anew) << "all known";
}

TEST_F(Recent, ResidualsAreNotPredictedAgain) {
  const std::vector<Hypothesis> plain = {{model_.nominal, {}}};
  RecentResiduals recent(kPlenty);
  const auto before = predicted(plain, &recent);
  for (double& torque : record_.torque[0]) torque += 1;  // the record is known by its address
  EXPECT_NE(predicted(plain, nullptr), before);
  EXPECT_EQ(predicted(plain, &recent), before);
}

TEST_F(Recent, ResidualsOfAnythingElseAreUnknown) {
  const Hypothesis plain{model_.nominal, {}};
  RecentResiduals recent(kPlenty);
  recent.keep(key(plain), {});
  Hypothesis other = with_effect("creep");
  recent.keep(key(other), {});
  EXPECT_TRUE(recent.find(key(other)));
  other.effects[0].p[0] += 1e-9;
  EXPECT_FALSE(recent.find(key(other))) << "another size";
  EXPECT_FALSE(recent.find(key(with_effect("backlash")))) << "another effect";
  EXPECT_FALSE(recent.find(key(with_more_friction(0.01)))) << "another number of the model";
  EXPECT_FALSE(recent.find(key(plain, true))) << "replayed";
}

TEST_F(Recent, ResidualsThatNobodyAskedForAreForgotten) {
  const Hypothesis first{model_.nominal, {}}, second = with_effect("creep"), third = with_effect("backlash");
  Residuals one;
  one.channel = {std::vector<double>(30'000), std::vector<double>(70'000)};
  RecentResiduals recent(250'000 * sizeof(double));
  recent.keep(key(first), one);
  recent.keep(key(second), one);
  recent.keep(key(second), one);  // the same ones take no more room
  EXPECT_TRUE(recent.find(key(first)));
  recent.keep(key(third), one);
  EXPECT_TRUE(recent.find(key(first)));
  EXPECT_FALSE(recent.find(key(second)));
  EXPECT_TRUE(recent.find(key(third)));
}

}  // namespace
}  // namespace halyard
