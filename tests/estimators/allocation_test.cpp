/// An update takes no memory from the heap but that of the innovation which it returns.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>

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

/// The most that one update takes, once the filter runs. Effects with internal states and sensor errors included.
long most_allocations(Estimator& estimator, const ArmRun& run) {
  constexpr std::size_t kFirst = 300;  // the history of commands doubles at 257 and 513 samples
  estimator.reset(run.samples[0]);
  long most = 0;
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    const long before = allocations;
    estimator.update(run.samples[i]);
    if (i >= kFirst) most = std::max<long>(most, allocations - before);
  }
  return most;
}

TEST(Allocations, AreCounted) {
  const long before = allocations;
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(100);
  EXPECT_EQ(allocations - before, 1) << x(0);
}

TEST(Allocations, AnUpdateTakesOnlyThoseOfItsInnovation) {
  const ArmModel model = raven2();
  const ArmRun run = run_arm(model, 0.5);
  constexpr long kInnovation = 2;  // nu and S_root
  EXPECT_EQ(most_allocations(*make_kinematics(model, {}), run), 0);
  EXPECT_LE(most_allocations(*make_ekf(model, {}), run), kInnovation);
  EXPECT_LE(most_allocations(*make_sr_ukf(model, {}), run), kInnovation);
  EXPECT_LE(most_allocations(*make_disturbance_sr_ukf(model, {}), run), kInnovation);
}

}  // namespace
}  // namespace halyard

#endif
