#include "diagnosis/prediction/start/let_down.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "diagnosis/motion/lane_drive.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

/// From stop to stop, s. A swing at ω is cos(ω t) of itself after each: of 2 to 100 Hz at most a fifteenth is left, of
/// 3 Hz and more at most a fiftieth.
constexpr double kFromStopToStop[] = {0.009, 0.011, 0.013, 0.017, 0.021, 0.026, 0.033, 0.041, 0.051, 0.064, 0.08, 0.1};
constexpr double kAfterLastStop = 0.3;  ///< s
/// Parts of the run in, s. Before each the joints are as fast as the motors again.
constexpr double kInStep[] = {0.015, 0.025, 0.04, 0.04};
static_assert(kInStep[0] + kInStep[1] + kInStep[2] + kInStep[3] > kRunIn - 1e-9);

/// With the motors `seconds` before the first sample.
DrivenInput moving_before(const StartOfMotion& motion, DrivenInput first, double seconds) {
  for (std::size_t k = 0; k < motion.angle.size(); ++k) {
    const double rate = motion.rate[k], acceleration = motion.acceleration[k];
    first.motor_angle[k] = motion.angle[k] - seconds * (rate - 0.5 * seconds * acceleration);
    first.motor_rate[k] = rate - seconds * acceleration;
    first.motor_acceleration[k] = acceleration;
  }
  return first;
}

}  // namespace

DrivenInput held_before(const Record& record, const DrivenInput& first) {
  DrivenInput held = record.first_motion.is_there() ? moving_before(record.first_motion, first, kRunIn) : first;
  std::ranges::fill(held.motor_rate, 0);
  std::ranges::fill(held.motor_acceleration, 0);
  return held;
}

UnstretchedMotion unstretched_motion(const Hypothesis& h, const StartOfMotion& motion) {
  if (!motion.is_there()) return {};
  const ArmParameters<double> arm = lift_transmission<double>(h.nominal, h.effects).arm();
  const Eigen::Map<const Eigen::VectorXd> rate(motion.rate.data(), arm.n),
      acceleration(motion.acceleration.data(), arm.n);
  return {unstretched_joints(arm, rate, rate), unstretched_joints(arm, acceleration, acceleration)};
}

void bring_to_start(const Transmission<Lanes>& transmission, const RungeKuttaChebyshev& scheme, const Record& record,
                    const DrivenInput& first, const CommandHistory& history, const Lanes* rate,
                    const Lanes* acceleration, DrivenState<Lanes>& x) {
  const auto samples = [&](double seconds) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(seconds / record.dt)));
  };
  std::size_t of_run_in = 0, left = samples(kAfterLastStop);
  for (const double seconds : kInStep) of_run_in += record.first_motion.is_there() ? samples(seconds) : 0;
  for (const double seconds : kFromStopToStop) left += samples(seconds);
  left += of_run_in;

  std::vector<Lanes> unused;
  const auto drive = [&](std::size_t count, const auto& input_before) {
    std::vector<DrivenInput> inputs;
    for (std::size_t i = 0; i < count; ++i) inputs.push_back(input_before(record.dt * static_cast<double>(left - i)));
    unused.resize(count * 2 * static_cast<std::size_t>(record.n));
    const double start = record.start - record.dt * static_cast<double>(left);
    lane_drives().front().drive(transmission, inputs.data(), count, start, record.dt, scheme, &history, x,
                                unused.data(), nullptr);
    left -= count;
  };
  const DrivenInput held = held_before(record, first);
  const auto still = [&](double) { return held; };
  for (const double seconds : kFromStopToStop) {
    drive(samples(seconds), still);
    std::fill_n(x.v, record.n, Lanes(0.0));
  }
  drive(samples(kAfterLastStop), still);
  if (!record.first_motion.is_there()) return;
  for (const double seconds : kInStep) {
    const Lanes before = record.dt * static_cast<double>(left);
    for (int k = 0; k < record.n; ++k) x.v[k] = rate[k] - before * acceleration[k];
    drive(samples(seconds), [&](double s) { return moving_before(record.first_motion, first, s); });
  }
}

}  // namespace halyard
