// The loops inside a body run to their end while another body throws.
#include "model/machine/first_failure.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace halyard {
namespace {

/// At most 10 s, if the machine never runs two bodies at once.
void wait_for(const std::atomic<bool>& flag) {
  for (int i = 0; i < 10000 && !flag; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(FirstFailure, LeavesTheLoopsOfOtherBodiesAlone) {
  std::atomic<bool> has_begun = false, has_failed = false;
  std::atomic<int> done = 0;
  FirstFailure failure;
  const auto body = [&](int i) {
    if (i == 0) {
      wait_for(has_begun);
      has_failed = true;
      throw std::runtime_error("of the first body");
    }
    has_begun = true;
    wait_for(has_failed);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));  // longer than an exception takes to cancel loops
    tbb::parallel_for(0, 100, [&](int) { ++done; });
  };
  const tbb::global_control two(tbb::global_control::max_allowed_parallelism, 2);
  tbb::task_arena arena(2);
  arena.execute(
      [&] { tbb::parallel_for(0, 2, [&](int i) { failure.keep(static_cast<std::size_t>(i), [&] { body(i); }); }); });
  EXPECT_EQ(done, 100);
  EXPECT_THROW(failure.rethrow(), std::runtime_error);
}

/// Two bodies at once: the second throws first.
TEST(FirstFailure, IsThatOfTheSmallestIndexWhicheverThreadIsFaster) {
  std::atomic<bool> has_failed = false;
  FirstFailure failure;
  std::thread other([&] {
    failure.keep(3, [&] {
      has_failed = true;
      throw std::runtime_error("third");
    });
  });
  failure.keep(2, [&] {
    wait_for(has_failed);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    throw std::logic_error("second");
  });
  other.join();
  bool has_run = false;
  failure.keep(4, [&] { has_run = true; });
  EXPECT_FALSE(has_run);
  failure.keep(1, [&] { has_run = true; });
  EXPECT_TRUE(has_run);
  EXPECT_THROW(failure.rethrow(), std::logic_error);
}

TEST(FirstFailure, OfALoopIsThatOfItsFirstBody) {
  std::atomic<int> done = 0;
  for_each_in_parallel(100, [&](std::size_t) { ++done; });
  EXPECT_EQ(done, 100);
  EXPECT_THROW(for_each_in_parallel(100,
                                    [&](std::size_t i) {
                                      if (i == 7) throw std::logic_error("of the seventh");
                                      if (i > 7) throw std::runtime_error("of a later one");
                                    }),
               std::logic_error);
}

}  // namespace
}  // namespace halyard
