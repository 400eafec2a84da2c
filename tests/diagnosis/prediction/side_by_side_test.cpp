/// Hypotheses with different effects, and jobs that wait for each other, get the numbers that they would get alone.

#include "diagnosis/prediction/side_by_side.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "diagnosis/prediction/shared_lanes.h"
#include "plant/simulate.h"
#include "tests/diagnosis/prediction/finite_numbers.h"
#include "tests/support/short_arm.h"

namespace halyard {
namespace {

constexpr int kStride = 10;

struct Recorded {
  ArmModel model = first_joints(2);
  Record record = make_records(simulate(motion(model, 2)).measured, model, {})[0];

  /// One hypothesis for each effect of the library, at the last place where the arm can have it; beside it the arm
  /// without effects, and with the effect twice if that is possible.
  std::vector<Hypothesis> one_of_each() const {
    std::vector<Hypothesis> all = {{model.nominal, {}}};
    for (const Effect* effect : effect_library()) {
      const auto places = effect_places(*effect, model.nominal);
      if (places.empty()) continue;
      all.push_back({model.nominal, {place_effect(*effect, model.nominal, places.back())}});
    }
    all.push_back({model.nominal, {all[2].effects[0], all[1].effects[0]}});
    all.push_back({model.nominal, {all[1].effects[0], all[2].effects[0], all[1].effects[0]}});
    return all;
  }
};

TEST(SharedLanes, GiveEachHypothesisTheNumbersThatItHasAlone) {
  const Recorded r;
  const std::vector<Hypothesis> all = r.one_of_each();
  std::vector<std::vector<Hypothesis>> single;
  for (const Hypothesis& h : all) single.push_back({h});
  std::vector<PredictionRequest> requests;
  for (const auto& hypotheses : single) requests.push_back({&r.record, &hypotheses, kStride});
  const auto together = predict(requests);
  ASSERT_GT(all.size(), 20U);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto alone = finite_numbers(predict(r.record, {all[i]}, kStride)[0]);
    ASSERT_GT(alone.size(), 100U) << i;
    EXPECT_EQ(finite_numbers(together[i][0]), alone) << i;
  }
}

TEST(CommonEffects, KeepTheOrderOfEachList) {
  const ArmModel model = first_joints(2);
  const PlacedEffect a = place_effect(*find_effect("backlash"), model.nominal, 0),
                     b = place_effect(*find_effect("stiffness"), model.nominal, 0),
                     c = place_effect(*find_effect("payload"), model.nominal, kWholeArm);
  const std::vector<std::vector<PlacedEffect>> lists = {{a, b}, {c, b}, {a, a}, {b, c}, {}};
  CommonEffects common;
  for (const auto& list : lists) common.add(list);
  for (const auto& list : lists) {
    const std::vector<std::size_t> places = common.places(list);
    ASSERT_EQ(places.size(), list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      EXPECT_EQ(common.all()[places[i]].effect, list[i].effect);
      EXPECT_TRUE(i == 0 || places[i - 1] < places[i]);
    }
  }
  EXPECT_EQ(common.all().size(), 5U) << "a b, c before b, the second a, c after b";
}

TEST(SideBySide, JobsThatAskUnequallyOftenGetTheNumbersThatTheyHaveAlone) {
  const Recorded r;
  const std::vector<Hypothesis> all = r.one_of_each();
  std::vector<std::vector<double>> beside(all.size());
  run_side_by_side(all.size(), [&](std::size_t i) {
    for (std::size_t times = 0; times <= i % 3; ++times)
      beside[i] = finite_numbers(predict(r.record, {all[i]}, kStride)[0]);
  });
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_EQ(beside[i], finite_numbers(predict(r.record, {all[i]}, kStride)[0])) << i;
}

TEST(SideBySide, AJobThatFailsDoesNotHoldUpTheOthers) {
  const Recorded r;
  const std::vector<Hypothesis> plain = {{r.model.nominal, {}}};
  std::atomic<int> done{0};
  const auto job = [&](std::size_t i) {
    if (i == 1) throw std::runtime_error("the second");
    if (i == 2) throw std::runtime_error("the third");
    predict(r.record, plain, kStride);
    ++done;
  };
  try {
    run_side_by_side(4, job);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the second");
  }
  EXPECT_EQ(done, 2);
}

}  // namespace
}  // namespace halyard
