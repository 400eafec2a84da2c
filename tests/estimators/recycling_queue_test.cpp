/// The queue of smoothers and cameras is a queue, however it grows and wraps.

#include "estimators/recycling_queue.h"

#include <gtest/gtest.h>

#include <deque>
#include <random>

namespace halyard {
namespace {

void expect_same(const RecyclingQueue<int>& queue, const std::deque<int>& model) {
  ASSERT_EQ(queue.size(), model.size());
  ASSERT_EQ(queue.empty(), model.empty());
  for (std::size_t i = 0; i < model.size(); ++i) ASSERT_EQ(queue[i], model[i]);
  if (!model.empty()) {
    ASSERT_EQ(queue.back(), model.back());
  }
}

TEST(RecyclingQueue, IsAQueueHoweverItGrowsAndWraps) {
  RecyclingQueue<int> queue;
  std::deque<int> model;
  std::mt19937 random(1);
  for (int step = 0; step < 2000; ++step) {
    const unsigned action = random() % 100;
    if (action < 60) {
      model.push_back(step);
      queue.append() = step;
      ASSERT_EQ(queue.back(), step);
    } else if (action < 97) {
      const std::size_t count = std::min<std::size_t>(random() % 3, model.size());
      model.erase(model.begin(), model.begin() + static_cast<std::ptrdiff_t>(count));
      queue.remove_front(count);
    } else {
      model.clear();
      queue.clear();
    }
    expect_same(queue, model);
    if (!model.empty()) {
      ASSERT_EQ(queue.front(), model.front());
    }
  }
}

TEST(RecyclingQueue, KeepsTheMemoryOfWhatIsRemoved) {
  RecyclingQueue<std::vector<int>> queue;
  queue.append().assign(100, 1);
  const int* const memory = queue.front().data();
  const auto capacity_found = [&] {  // after a turn around the slots
    for (int i = 0; i < 100; ++i) {
      if (queue.append().data() == memory) return true;
      queue.remove_front();
    }
    return false;
  };
  queue.remove_front();
  EXPECT_TRUE(capacity_found());
}

TEST(RecyclingQueue, RemovingNothingFromAnEmptyOneIsAllowed) {
  RecyclingQueue<int> queue;
  queue.remove_front(0);
  EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace halyard
