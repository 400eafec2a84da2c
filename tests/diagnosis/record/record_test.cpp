#include "diagnosis/record/record.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "model/input_error.h"
#include "model/model_file.h"
#include "tests/diagnosis/fit/made_log.h"
#include "tests/support/limits.h"
#include "tests/support/message_of.h"
#include "tests/support/pendulum.h"

namespace halyard {
namespace {

/// One kernel, of 20 Hz.
const RecordOptions kOneKernel{.motion_hz = 20, .compare_hz = 0};

ArmModel raven2() { return read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml"); }

/// A log of three joints in which every signal is the same function of time.
Log log_of(const std::function<double(double)>& x, double duration, double rate_hz, double start = 0) {
  Log log(3);
  log.source = "some.csv";
  for (long i = 0; i <= std::lround(duration * rate_hz); ++i)
    log.time.push_back(start + static_cast<double>(i) / rate_hz);
  for (Signals* signals : {&log.motor_position, &log.motor_torque, &log.joint_position, &log.joint_torque})
    for (std::vector<double>& column : *signals)
      for (const double t : log.time) column.push_back(x(t));
  return log;
}

/// Far enough from the ends for the kernel not to see them.
bool inside(const Record& r, std::size_t i) { return i * r.dt > 0.1 && (r.size - 1 - i) * r.dt > 0.1; }

// σ_t is 8 ms: kernels of slope and curvature weigh readings below 10, ten roundings each, by 1 / σ_t and 2 / σ_t².
constexpr double kValueRounding = 10 * 10 * kEps;
constexpr double kSlopeRounding = kValueRounding / 8e-3;
constexpr double kCurvatureRounding = 2 * kValueRounding / 8e-3 / 8e-3;

TEST(Record, RampsKeepTheirValueAndSlopeUpToTheEnds) {
  const auto ramp = [](double t) { return 1.5 - 0.8 * t; };
  const Record r = make_records(log_of(ramp, 4, 1000), raven2(), kOneKernel)[0];
  for (std::size_t i = 0; i < r.size; ++i) {
    EXPECT_NEAR(r.motor_angle[1][i], ramp(r.time(i)), kValueRounding);
    EXPECT_NEAR(r.motor_rate[1][i], -0.8, kSlopeRounding);
    EXPECT_NEAR(r.motor_acceleration[1][i], 0, kCurvatureRounding);
    EXPECT_NEAR(r.joint[1][i], ramp(r.time(i)), kValueRounding);
    EXPECT_NEAR(r.external[1][i], ramp(r.time(i)), kValueRounding);
  }
}

TEST(Record, OfAnArmWithoutMotorsNeedsAnySignalOfIts) {
  Log log(1);
  log.source = "loads.csv";
  for (int i = 0; i <= 2000; ++i) log.time.push_back(1e-3 * i), log.joint_torque[0].push_back(0);
  EXPECT_EQ(message_of([&] { make_records(log, pendulum(), {}); }),
            "loads.csv: has no motion, no torque and no joint sensor of this arm; give a log with one");
}

TEST(Record, NeedsThePositionOfEachMotor) {
  Log log = log_of([](double t) { return t; }, 4, 1000);
  log.motor_position[1].clear();
  EXPECT_EQ(message_of([&] { make_records(log, raven2(), {}); }),
            "some.csv: has no motor_position_2; expected the angle of every motor of the model");
  ArmModel model = raven2();
  model.nominal.joint[1].drive = Drive::none;
  EXPECT_EQ(make_records(log, model, {}).size(), 1u);
}

TEST(Record, ParabolasKeepTheirSlopeAndCurvature) {
  const auto parabola = [](double t) { return 1 + 0.3 * t - 0.7 * t * t; };
  const Record r = make_records(log_of(parabola, 4, 1000), raven2(), kOneKernel)[0];
  for (std::size_t i = 0; i < r.size; ++i) {
    if (!inside(r, i)) continue;
    EXPECT_NEAR(r.motor_rate[0][i], 0.3 - 1.4 * r.time(i), kSlopeRounding);
    EXPECT_NEAR(r.motor_acceleration[0][i], -1.4, kCurvatureRounding);
  }
}

TEST(Record, TorqueIsThatOfTheMiddleOfTheHold) {
  // A command is held until the next sample: what acts at a sample is the mean of what was held before and after it.
  const auto ramp = [](double t) { return 2 * t; };
  const Record r = make_records(log_of(ramp, 4, 1000), raven2(), kOneKernel)[0];
  for (std::size_t i = 0; i < r.size; ++i) {
    if (inside(r, i)) {
      EXPECT_NEAR(r.torque[2][i], ramp(r.time(i) - 0.5e-3), kValueRounding);
    }
  }
}

TEST(Record, EverySignalPassesOneFilterWhateverTheSampleRate) {
  const double f = 2, w = 2 * std::numbers::pi * f;
  const auto sine = [&](double t) { return std::sin(w * t); };
  // A Gaussian of cut-off f_c passes exp(-(f / f_c)² / 2); cut off at four deviations it is wrong by 1e-4 at most.
  const double gain = std::exp(-0.5 * (f / 20) * (f / 20));
  const std::pair<double, double> rate_and_step[] = {{250, 2e-3}, {400, 1.25e-3}, {1000, 2e-3}, {3000, 2e-3}};
  for (const auto& [rate, step] : rate_and_step) {
    const Record r = make_records(log_of(sine, 3, rate, 0.25), raven2(), kOneKernel)[0];
    EXPECT_NEAR(r.dt, step, 1e-12) << rate;
    EXPECT_EQ(r.start, 0.25);
    EXPECT_EQ(r.size, static_cast<std::size_t>(std::lround(3 / step)) + 1) << rate;
    // Between samples further apart than the grid interpolation adds an error of the order (ω h)⁴.
    const double tolerance = 2e-4 + (rate < 500 ? std::pow(w / rate, 4) : 0);
    for (std::size_t i = 0; i < r.size; ++i) {
      if (!inside(r, i)) continue;
      const double t = r.time(i);
      EXPECT_NEAR(r.motor_angle[0][i], gain * std::sin(w * t), 2e-4);
      EXPECT_NEAR(r.motor_rate[0][i], gain * w * std::cos(w * t), tolerance * w);
      EXPECT_NEAR(r.motor_acceleration[0][i], -gain * w * w * std::sin(w * t), tolerance * w * w);
      EXPECT_NEAR(r.torque[0][i], gain * std::sin(w * (t - 0.5 * std::min(1 / rate, kLongestHold))), 2e-4);
      EXPECT_NEAR(r.joint[0][i], r.motor_angle[0][i], 1e-12);
    }
  }
}

TEST(Record, AMeasuredTorqueIsThatOfItsSample) {
  const auto ramp = [](double t) { return 3 * t; };
  ArmModel model = raven2();
  for (const TorqueSource source : {TorqueSource::commanded, TorqueSource::measured}) {
    model.nominal.joint[0].torque_source = source;
    const Record r = make_records(log_of(ramp, 3, 1000), model, kOneKernel)[0];
    const double later = source == TorqueSource::measured ? 0 : 0.5e-3;
    for (std::size_t i = 0; i < r.size; ++i)
      if (inside(r, i)) EXPECT_NEAR(r.torque[0][i], ramp(r.time(i) - later), 1e-12);
  }
}

TEST(Record, LongGapsSplitALogAndShortOnesDoNot) {
  for (const double gap : {0.03, 0.2}) {
    Log whole = log_of([](double t) { return t; }, 6, 1000), log(3);
    log.source = whole.source;
    for (std::size_t i = 0; i < whole.size(); ++i) {
      if (whole.time[i] > 2 && whole.time[i] < 2 + gap) continue;
      log.time.push_back(whole.time[i]);
      for (int k = 0; k < 3; ++k) {
        log.motor_position[k].push_back(whole.motor_position[k][i]);
        log.motor_torque[k].push_back(whole.motor_torque[k][i]);
        log.joint_position[k].push_back(whole.joint_position[k][i]);
      }
    }
    const std::vector<Record> records = make_records(log, raven2(), kOneKernel);
    if (gap < 0.05) {
      ASSERT_EQ(records.size(), 1u);
      const std::size_t middle = static_cast<std::size_t>(std::lround(2.016 / records[0].dt));
      EXPECT_EQ(records[0].torque_valid[0][middle], 0) << "nothing was measured there";
      EXPECT_NEAR(records[0].motor_angle[0][middle], 2.016, 1e-12) << "a ramp goes on through a short gap";
    } else {
      ASSERT_EQ(records.size(), 2u);
      EXPECT_NEAR(records[0].time(records[0].size - 1), 2.0, 1e-9);
      EXPECT_NEAR(records[1].start, 2.2, 1e-3);
      EXPECT_EQ(records[1].torque_valid[0][10], 0) << "settles anew";
    }
  }
}

TEST(Record, StretchesTooShortToCompareAreLeftOut) {
  Log log = log_of([](double t) { return t; }, 4, 1000);
  for (std::size_t i = 0; i < log.size(); ++i)
    if (log.time[i] > 1.0005) log.time[i] += 1;  // the first second alone
  const std::vector<Record> records = make_records(log, raven2(), kOneKernel);
  ASSERT_EQ(records.size(), 1u);
  EXPECT_NEAR(records[0].start, 2.001, 1e-9);
}

TEST(Record, SaysThatALogIsTooShort) {
  const auto message = [](const Log& log) -> std::string {
    try {
      make_records(log, raven2(), kOneKernel);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(message(log_of([](double t) { return t; }, 1.4, 1000)),
            "some.csv: no stretch to learn from or to hold out is longer than 1.5 s without gaps; expected a longer "
            "record, or a hold-out log of its own");
  EXPECT_EQ(message(log_of([](double t) { return t; }, 0, 1000)),
            "some.csv: has fewer than two samples; expected a record of at least a second");
}

TEST(Record, DropOutsAreMaskedInTheSignalsThatNeedThem) {
  Log log = log_of([](double t) { return std::sin(t); }, 4, 1000);
  for (int i = 2000; i < 2020; ++i) log.joint_position[0][i] = kNan;
  for (int i = 2500; i < 2520; ++i) log.motor_torque[0][i] = kNan;
  for (int i = 3000; i < 3020; ++i) log.motor_position[0][i] = kNan;
  const Record r = make_records(log, raven2(), kOneKernel)[0];
  for (std::size_t i = 0; i < r.size; ++i) {
    const double t = r.time(i);
    const bool settled = t >= 0.5 - 1e-9;
    const auto in = [&](double from) { return t > from + 1.5e-3 && t < from + 0.0175; };
    const auto near = [&](double from) { return t > from - 1.5e-3 && t < from + 0.0215; };
    // At a sample next to a drop-out either is right: it lies within one sample of one that is there.
    const bool joint_there = !near(2) && !near(3), torque_there = !near(2.5) && !near(3);
    EXPECT_TRUE(!joint_there || r.joint_valid[0][i] == settled) << t;
    // Near the end the filter of the torque, 4 σ_t = 32 ms wide, sees a signal that was made up.
    const bool at_the_edge = std::abs(t - (4 - 0.032)) < 2.5e-3, inside = t < 4 - 0.032;
    EXPECT_TRUE(!torque_there || at_the_edge || r.torque_valid[0][i] == (settled && inside)) << t;
    EXPECT_TRUE(!(in(2) || in(3)) || r.joint_valid[0][i] == 0) << t;
    EXPECT_TRUE(!(in(2.5) || in(3)) || r.torque_valid[0][i] == 0) << t;
    EXPECT_EQ(r.joint_valid[1][i], settled) << "another joint";
    for (const Signals* x : {&r.motor_acceleration, &r.joint, &r.torque}) EXPECT_TRUE(std::isfinite((*x)[0][i])) << t;
  }
}

TEST(Record, ASlowSensorIsComparedWhereItWasRead) {
  Log log = log_of([](double t) { return std::sin(3 * t); }, 4, 1000);
  for (std::size_t i = 0; i < log.size(); ++i)
    if (i % 10 != 3) log.joint_position[0][i] = kNan;  // 100 Hz
  const Record r = make_records(log, raven2(), {})[0];
  double measured = 0, valid = 0;
  for (std::size_t i = 0; i < r.size; ++i) {
    const double t = r.time(i), phase = std::remainder(t - 0.003, 0.01);
    if (r.joint_measured[0][i] > 0) {
      EXPECT_LT(std::abs(phase), 1.03e-3) << t;
    }
    measured += r.joint_measured[0][i];
    valid += r.joint_valid[0][i];
    // Cubic interpolation over h = 10 ms of (ω = 3): (ω h)⁴; the filter takes (ω / (2π 60 Hz))² / 2 of both.
    if (inside(r, i)) {
      EXPECT_NEAR(r.joint[0][i], r.joint[1][i], std::pow(3 * 0.01, 4)) << t;
    }
  }
  EXPECT_NEAR(measured, 2 * 350, 3) << "of 3.5 s; either neighbour of an odd millisecond is as near";
  EXPECT_NEAR(valid, 3.5 / r.dt, 10) << "the comparing kernel sees samples everywhere";
}

TEST(Record, AHoleInAMotorsPositionSplitsALogThoughRowsGoOn) {
  Log log = log_of([](double t) { return t; }, 6, 1000);
  for (int i = 2000; i < 2300; ++i) log.motor_position[1][i] = kNan;
  const std::vector<Record> records = make_records(log, raven2(), kOneKernel);
  ASSERT_EQ(records.size(), 2u);
  EXPECT_NEAR(records[0].time(records[0].size - 1), 2, 3e-3);
  EXPECT_NEAR(records[1].start, 2.3, 1e-9);
}

TEST(Record, ASensorThatNeverChangesTellsNothingUnlessItsResolutionIsStated) {
  ArmModel model = raven2();
  model.nominal.joint[0].joint_encoder_resolution = 0;
  model.nominal.joint[1].joint_encoder_resolution = 0;
  model.nominal.joint[2].joint_encoder_resolution = 1e-3;
  // The motors move less than what makes a sensor stuck.
  Log log = log_of([](double t) { return 1e-6 * std::sin(t); }, 4, 1000);
  for (const int k : {0, 2}) std::ranges::fill(log.joint_position[k], 0.25);
  std::ranges::fill(log.motor_torque[0], 0);
  std::ranges::fill(log.motor_torque[1], 0.1);
  const Record r = make_records(log, model, {})[0];
  EXPECT_FALSE(r.has_joint(0)) << "never changes";
  EXPECT_TRUE(r.has_joint(1)) << "changes";
  EXPECT_TRUE(r.has_joint(2)) << "a coarse sensor of a joint that hardly moves";
  EXPECT_FALSE(r.has_torque(0)) << "always zero";
  EXPECT_TRUE(r.has_torque(1)) << "constant";
}

TEST(Record, ASensorIsStuckWhicheverRowsHaveItsMotorsPosition) {
  const ArmModel model = raven2();
  for (const std::size_t first : {0, 5}) {
    Log log = log_of([](double t) { return 200 * std::sin(t); }, 4, 1000);
    std::ranges::fill(log.joint_position[1], 0.25);
    for (std::vector<double>& column : log.motor_position)
      for (std::size_t i = 0; i < column.size(); ++i)
        if (i % 10 != first) column[i] = kNan;
    EXPECT_EQ(stuck_joint_sensors(log, model), std::vector{1}) << first;
  }
}

TEST(Record, AbsentColumnsAndJointsWithoutMotorHaveNothingToCompare) {
  ArmModel model = raven2();
  model.nominal.joint[2].drive = Drive::none;
  Log log = log_of([](double t) { return std::sin(t); }, 4, 1000);
  log.joint_position[1].clear();
  log.motor_torque[0].clear();
  log.joint_torque[0].clear();
  const Record r = make_records(log, model, {})[0];
  EXPECT_FALSE(r.has_joint(1));
  EXPECT_FALSE(r.has_torque(0));
  EXPECT_FALSE(r.has_torque(2));
  EXPECT_TRUE(r.external[0].empty());
  for (std::size_t i = 0; i < r.size; ++i) {
    EXPECT_EQ(r.motor_angle[2][i], r.joint[2][i]) << "the joint's own motion";
    EXPECT_EQ(r.joint_valid[2][i], 0) << "which is given";
    EXPECT_EQ(r.torque_valid[0][i] + r.torque_valid[2][i] + r.joint_valid[1][i], 0);
  }
}

TEST(Record, BeginsAndEndsWithThePositionsOfAllMotors) {
  Log log = log_of([](double t) { return t; }, 6, 1000);
  for (int i = 0; i < 1000; ++i) log.motor_position[0][i] = kNan;
  for (int i = 4000; i <= 6000; ++i) log.motor_position[1][i] = kNan;
  const std::vector<Record> records = make_records(log, raven2(), kOneKernel);
  ASSERT_EQ(records.size(), 1u);
  EXPECT_NEAR(records[0].start, 1, 1e-9);
  EXPECT_NEAR(records[0].time(records[0].size - 1), 4, 3e-3);
}

TEST(Record, OfALightJointIsIntegratedWithMoreStagesThanUsual) {
  const auto stages = [](const ArmModel& model) {
    return make_records(log_of([](double t) { return std::sin(t); }, 3, 100), model, {})[0].most_stages;
  };
  ArmModel wrist = raven2();
  EXPECT_EQ(stages(wrist), RungeKuttaChebyshev::kUsualStages);
  JointParameters<double>& j = wrist.nominal.joint[2];
  j.mass = 1e-3, j.joint_coulomb = 5, j.joint_smoothing = 1e-3;  // 5e6 1/s
  EXPECT_GT(stages(wrist), 2 * RungeKuttaChebyshev::kUsualStages);
  EXPECT_LE(stages(wrist), RungeKuttaChebyshev::kMostStages);
  j.mass = 1e-9;
  EXPECT_EQ(stages(wrist), RungeKuttaChebyshev::kMostStages) << "and not enough: the prediction refuses it";
}

TEST(Record, NeedsTenSamplesASecond) {
  const auto message = [](double rate_hz) {
    Log log = log_along(4, rate_hz, slow_swing);
    log.source = "slow.csv";
    return message_of([&] { make_records(log, first_joints(1), {}); });
  };
  EXPECT_EQ(message(10).find("a sample follows another"), std::string::npos) << message(10);
  EXPECT_EQ(message(5),
            "slow.csv: a sample follows another after 0.2 s; expected at least 10 samples a second; if its time is not "
            "in s, say so by a column map, such as time=NAME,unit=ms");
}

}  // namespace
}  // namespace halyard
