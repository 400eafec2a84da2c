/// An update takes no memory from the heap, once the estimator runs. At a restart after a gap it may.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <limits>

#include "estimators/built_in.h"
#include "tests/support/arm_runs.h"

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)

namespace {
std::atomic<long> allocations{0};
}  // namespace

// Eigen and operator new both take their memory by malloc().
extern "C" void* __libc_malloc(std::size_t size);  // NOLINT: glibc's name
extern "C" void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}

namespace halyard {
namespace {

/// The samples of a run as a live loop may see them: every 7th lacks a motor's reading, every 33rd has a marker.
std::vector<Sample> live_samples(const ArmRun& run) {
  std::vector<Sample> samples = run.samples;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (i % 7 == 0) samples[i].motor_position(1) = std::numeric_limits<double>::quiet_NaN();
    if (i % 33 == 0) samples[i].marker = Eigen::Vector3d(0.05, 0.02, -0.06);
  }
  return samples;
}

/// The most that one update takes from sample `first` on.
long most_allocations(Estimator& estimator, const std::vector<Sample>& samples, std::size_t first) {
  estimator.reset(samples[0]);
  long most = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const long before = allocations;
    estimator.update(samples[i]);
    if (i >= first) most = std::max<long>(most, allocations - before);
    while (estimator.revise(false)) {}
  }
  return most;
}

TEST(Allocations, AreCounted) {
  const long before = allocations;
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(100);
  EXPECT_EQ(allocations - before, 1) << x(0);
}

TEST(Allocations, AnUpdateOfABuiltInEstimatorTakesNone) {
  const ArmModel model = raven2();
  const std::vector<Sample> samples = live_samples(run_arm(model, 3));
  constexpr std::size_t kSoon = 10;
  EXPECT_EQ(most_allocations(*make_kinematics(model, {}), samples, kSoon), 0);
  EXPECT_EQ(most_allocations(*make_ekf(model, {}), samples, kSoon), 0);
  EXPECT_EQ(most_allocations(*make_sr_ukf(model, {}), samples, kSoon), 0);
  EXPECT_EQ(most_allocations(*make_disturbance_sr_ukf(model, {}), samples, kSoon), 0);
  // These remember samples: the marker's latency, 50 ms, and twice the lag, 0.4 s.
  EXPECT_EQ(most_allocations(*make_camera_sr_ukf(model, {}), samples, 200), 0);
  EXPECT_EQ(most_allocations(*make_smoother(model, {}), samples, 1000), 0);
}

TEST(Allocations, AnUpdateTakesNoneWithAnyEffectOfTheLibrary) {
  for (const Effect* effect : effect_library()) {
    ArmModel model = raven2();
    const std::vector<EffectPlace> places = effect_places(*effect, model.nominal);
    if (places.empty()) continue;
    model.effects.push_back(place_effect(*effect, model.nominal, places.back()));
    const std::vector<Sample> samples = live_samples(run_arm(model, 0.1));
    EXPECT_EQ(most_allocations(*make_ekf(model, {}), samples, 10), 0) << effect->name();
    EXPECT_EQ(most_allocations(*make_sr_ukf(model, {}), samples, 10), 0) << effect->name();
  }
}

}  // namespace
}  // namespace halyard

#endif
