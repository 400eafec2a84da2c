#include "estimators/process/process_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "estimators/process/static_equilibrium.h"
#include "tests/support/arm_runs.h"
#include "tests/support/limits.h"
#include "tests/support/message_of.h"
#include "tests/support/pendulum.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

constexpr double kTorque[3] = {0.02, -0.01, 0.015};
constexpr double kLoad[3] = {0.1, -0.2, 0.5};

/// The arm with effects of every kind: states, parameters of the arm, friction that depends on load.
ArmModel arm_with_effects() {
  ArmModel model = raven2();
  add_effect(model, "hysteresis", 2, {0.4, 1e-4});
  add_effect(model, "pulley_friction", 1, {0.05, 0.5});
  add_effect(model, "payload", kWholeArm, {0.1});
  return model;
}

/// A size of each state over which the equations change their course.
Eigen::VectorXd state_sizes(const ProcessModel& process) {
  const StateLayout& l = process.layout();
  Eigen::VectorXd sizes = Eigen::VectorXd::Constant(process.n_states(), 1e-4);
  for (int k = 0; k < process.n_joints(); ++k) {
    const JointParameters<double>& j = process.arm().joint[k];
    sizes(l.position[k]) = 1e-4;
    sizes(l.rate[k]) = j.joint_smoothing;
    if (!l.motor_angle[k]) continue;
    sizes(*l.motor_angle[k]) = 1e-4 / j.motor_travel();
    sizes(*l.motor_rate[k]) = j.motor_smoothing;
  }
  return sizes;
}

/// States around home, moving slowly, cables pulled by a few newtons.
Eigen::MatrixXd some_states(const ProcessModel& process, const ArmModel& model, int count) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const Eigen::VectorXd home = model.home(), sizes = state_sizes(process);
  Eigen::MatrixXd X(process.n_states(), count);
  for (int c = 0; c < count; ++c) {
    X.col(c) = process.state_at_rest(unstretched_motors(process.arm(), home), home);
    for (int i = 0; i < process.n_states(); ++i) X(i, c) += sizes(i) * normal(random);
  }
  return X;
}

TEST(ProcessModel, NamesItsStates) {
  const ProcessModel process(arm_with_effects());
  EXPECT_EQ(process.n_states(), 13);
  EXPECT_EQ(process.state_name(0), "motor_angle_1");
  EXPECT_EQ(process.state_name(3), "joint_position_2");
  EXPECT_EQ(process.state_name(9), "joint_rate_2");
  EXPECT_EQ(process.state_name(12), "hysteresis_3_state_1");
}

TEST(ProcessModel, JacobianOfAStepIsThatOfFiniteDifferences) {
  const ArmModel model = arm_with_effects();
  const ProcessModel process(model);
  const int n = process.n_states();
  const Eigen::VectorXd sizes = state_sizes(process);
  const Eigen::VectorXd x = some_states(process, model, 1).col(0);
  const Step step{0, 1e-3, kTorque, kLoad, nullptr};
  Eigen::VectorXd next = x, same = x;
  Eigen::MatrixXd F(n, n);
  process.advance_with_jacobian(step, next.data(), F);
  process.advance(step, same.data());
  const double relative = 1e-4;
  for (int c = 0; c < n; ++c) {
    Eigen::VectorXd above = x, below = x;
    above(c) += relative * sizes(c);
    below(c) -= relative * sizes(c);
    process.advance(step, above.data());
    process.advance(step, below.data());
    for (int r = 0; r < n; ++r) {
      const double difference = (above(r) - below(r)) / (2 * relative);  // ∂x_r per size of state c
      // In units of the states' sizes derivatives are of the order of 10: truncation 10 relative², and the rounding of
      // motor angles of 900 rad over the step.
      const double tolerance = 10 * relative * relative * sizes(r) + 4 * std::abs(x(r)) * kEps / relative;
      EXPECT_NEAR(F(r, c) * sizes(c), difference, tolerance)
          << process.state_name(r) << " by " << process.state_name(c);
    }
  }
  for (int i = 0; i < n; ++i) EXPECT_NEAR(next(i), same(i), 1e-11 * std::max(1.0, std::abs(same(i))));
}

TEST(ProcessModel, LanesOfEveryInstructionSetEqualTheScalarStepToRounding) {
  const ArmModel model = arm_with_effects();
  const ProcessModel process(model);
  const Step step{0, 1e-3, kTorque, kLoad, nullptr};
  const Eigen::MatrixXd X = some_states(process, model, 25);
  Eigen::MatrixXd scalar = X;
  for (int c = 0; c < 25; ++c) process.advance(step, scalar.col(c).data());
  ASSERT_EQ(lane_kernels().back().name, std::string("generic"));
  for (const LaneKernels& kernels : lane_kernels()) {
    Eigen::MatrixXd lanes = X;
    process.advance_many(step, lanes, kernels);
    for (int c = 0; c < 25; ++c)
      for (int i = 0; i < process.n_states(); ++i)
        // A stretch is the difference of 0.4 m, good to 1e-16 m: 1e-10 N at 1.4e6 N/m, and with the motor's inertia
        // 1e-12 rad/s a step; ten such roundings.
        EXPECT_NEAR(lanes(i, c), scalar(i, c), 1e-11 * std::max(1.0, std::abs(scalar(i, c))))
            << kernels.name << ", " << process.state_name(i);
    // The values of the Jacobian's pass, and its derivatives between sets.
    Eigen::VectorXd x = X.col(3), y = X.col(3);
    Eigen::MatrixXd F(process.n_states(), process.n_states()), G = F;
    process.advance_with_jacobian(step, x.data(), F, kernels);
    process.advance_with_jacobian(step, y.data(), G, lane_kernels().back());
    EXPECT_LT((F - G).cwiseAbs().maxCoeff(), 1e-11 * G.cwiseAbs().maxCoeff()) << kernels.name;
  }
}

TEST(ProcessModel, AStateDoesNotFeelItsNeighboursInABatch) {
  const ArmModel model = arm_with_effects();
  const ProcessModel process(model);
  const Step step{0, 1e-3, kTorque, nullptr, nullptr};
  const Eigen::MatrixXd X = some_states(process, model, 25);
  Eigen::MatrixXd all = X;
  process.advance_many(step, all);
  for (const int count : {1, 7, 8, 9}) {
    Eigen::MatrixXd some = X.leftCols(count);
    process.advance_many(step, some);
    EXPECT_EQ(some, all.leftCols(count)) << count;
  }
}

/// Joint rates, in units of the friction's v_s, every millisecond of 0.2 s in which motors creep away from rest.
Eigen::MatrixXd rates_from_standstill(const ProcessModel& process, const ArmModel& model, int parts) {
  const StateLayout& l = process.layout();
  const Eigen::VectorXd home = model.home(), none = Eigen::VectorXd::Zero(3);
  const Eigen::VectorXd q_m = unstretched_motors(process.arm(), home);
  Eigen::VectorXd x = process.state_at_rest(q_m, static_equilibrium(process, 0, q_m, none, Eigen::VectorXd(), home));
  double torque[3], load[3] = {};
  for (int k = 0; k < 3; ++k) torque[k] = 0.3 * process.arm().joint[k].motor_coulomb;
  Eigen::MatrixXd rates(3, 200);
  for (int i = 0; i < 200; ++i) {
    for (int part = 0; part < parts; ++part)
      runge_kutta_4(process.transmission(), l, 0, 1e-3 / parts, nullptr, torque, load, x.data());
    for (int k = 0; k < 3; ++k) rates(k, i) = x(l.rate[k]) / process.arm().joint[k].joint_smoothing;
  }
  return rates;
}

TEST(ProcessModel, SubStepsKeepStickStableAndFewerDoNot) {
  ArmModel model = raven2();
  for (int k = 0; k < 3; ++k) model.nominal.joint[k].joint_smoothing *= 0.2;  // as sharp as 1e-3 rad/s
  const ProcessModel process(model);
  const int parts = process.substeps(1e-3);
  EXPECT_LE(process.stiffest_rate() * 1e-3 / parts, 2.2);
  EXPECT_GT(process.stiffest_rate() * 1e-3 / (parts - 1), 2.2);
  const Eigen::MatrixXd fine = rates_from_standstill(process, model, 8 * parts);
  // A stable step damps the stiff mode a little wrongly, for a few milliseconds and far below v_s; an unstable one
  // lets it hunt across v_s or beyond all bounds.
  EXPECT_LT((rates_from_standstill(process, model, parts) - fine).cwiseAbs().maxCoeff(), 0.01);
  const Eigen::MatrixXd coarse = rates_from_standstill(process, model, parts / 3);
  EXPECT_FALSE((coarse - fine).cwiseAbs().maxCoeff() < 1);  // not finite counts
}

TEST(ProcessModel, AModelTooStiffForTheStepIsRefusedWithTheReason) {
  ArmModel model = raven2();
  model.nominal.joint[2].joint_smoothing = 1e-7;
  const ProcessModel process(model);
  EXPECT_EQ(process.stiffest_state(), "joint_rate_3");
  EXPECT_NO_THROW(process.substeps(1e-6));
  try {
    process.substeps(1e-3);
    FAIL() << "accepted";
  } catch (const std::runtime_error& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("joint_rate_3"), std::string::npos) << text;
    EXPECT_NE(text.find("sub-steps (at most 500)"), std::string::npos) << text;
  }
}

TEST(ProcessModel, ARowThatIsMissingMakesNoModelTooStiff) {
  const ProcessModel process(chain_of(7, 10));
  const int prompt = process.substeps(1e-3), after_ten = process.substeps(10e-3);
  EXPECT_LT(prompt, ProcessModel::kMaxSubsteps);
  EXPECT_GT(after_ten, ProcessModel::kMaxSubsteps);
  EXPECT_LE(after_ten, 10 * prompt);
}

TEST(ProcessModel, AResultThatIsNotFiniteThrowsWithTimeAndState) {
  const ArmModel model = raven2();
  const ProcessModel process(model);
  const double torque[3] = {0, std::numeric_limits<double>::infinity(), 0};
  const Step step{2, 0.5e-3, torque, nullptr, nullptr};
  Eigen::MatrixXd X = some_states(process, model, 3), F(12, 12);
  Eigen::VectorXd x = X.col(0), y = x;
  const std::vector<std::function<void()>> calls = {[&] { process.advance(step, x.data()); },
                                                    [&] { process.advance_many(step, X); },
                                                    [&] { process.advance_with_jacobian(step, y.data(), F); }};
  for (const auto& call : calls) {
    try {
      call();
      FAIL() << "accepted";
    } catch (const std::runtime_error& e) {
      const std::string text = e.what();
      EXPECT_NE(text.find("is not finite at 2.0005 s"), std::string::npos) << text;
      EXPECT_NE(text.find("_"), std::string::npos) << text;
    }
  }
}

TEST(ProcessModel, RungeKuttaIsOfFourthOrder) {
  const ProcessModel process(pendulum());
  const auto after_half_a_second = [&](int steps) {
    Eigen::Vector2d x(1, 0);
    const double none[1] = {};
    for (int i = 0; i < steps; ++i)
      runge_kutta_4(process.transmission(), process.layout(), 0, 0.5 / steps, nullptr, none, none, x.data());
    return x(0);
  };
  const double exact = after_half_a_second(640);
  const double ratio = (after_half_a_second(10) - exact) / (after_half_a_second(20) - exact);
  EXPECT_NEAR(ratio, 16, 2);  // 2⁴ and the next order
}

TEST(ProcessModel, RigidDriveCarriesItsRotorAlong) {
  ArmModel model = pendulum();
  JointParameters<double>& j = model.nominal.joint[0];
  j.type = JointType::prismatic;
  j.drive = Drive::rigid;
  j.mass = 2;
  j.rotor_inertia = 1e-3;
  j.gear_ratio = 10;
  j.capstan_radius = 0.1;
  j.motor_encoder_offset = 0.25;
  model.nominal.gravity[0] = 0;
  const ProcessModel process(model);
  const double travel = 0.01, torque[1] = {0.3};
  Eigen::Vector2d x(0.1, 0);
  process.advance({0, 0.1, torque, nullptr, nullptr}, x.data());
  const double acceleration = torque[0] / travel / (2 + 1e-3 / (travel * travel));
  EXPECT_NEAR(x(0), 0.1 + 0.5 * acceleration * 0.01, 10 * kEps);  // Runge-Kutta is exact for a parabola
  EXPECT_NEAR(x(1), acceleration * 0.1, 10 * kEps);
  Eigen::MatrixXd H;
  EXPECT_NEAR(process.motor_readings(0, x, &H)(0), x(0) / travel + 0.25, 100 * kEps);
  EXPECT_NEAR(H(0, 0), 1 / travel, 100 * kEps / travel);
  EXPECT_EQ(H(0, 1), 0);
}

/// A motor encoder whose error turns with the motor.
class EccentricEncoder : public EffectOf<EccentricEncoder> {
 public:
  std::string name() const override { return "test_eccentric_encoder"; }
  std::string summary() const override { return "for tests"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::sensors); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"amplitude", "rad", 0, 0.01, 0, 1}};
  }
  template <class T>
  void on_sensors(const EffectContext<T>& c, JointSignals<T>* s) const {
    s[*c.joint].motor_error += c.p[0] * sin(s[*c.joint].motor_angle);
  }
};

/// A torque that acts later than it is commanded.
class Late : public EffectOf<Late> {
 public:
  std::string name() const override { return "test_late"; }
  std::string summary() const override { return "for tests"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::command); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override {
    return {{"time", "s", 0, 0.01, 0, 1}};
  }
  template <class T>
  void on_command(const EffectContext<T>& c, JointSignals<T>* s) const {
    if (c.history) s[*c.joint].motor_torque = c.history->at(*c.joint, T(c.time) - c.p[0]);
  }
};

class WithTestEffects : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (find_effect("test_late")) return;
    register_effect(std::make_unique<EccentricEncoder>());
    register_effect(std::make_unique<Late>());
  }
};

TEST_F(WithTestEffects, SensorEffectsEnterTheReadingsAndTheirJacobian) {
  ArmModel model = raven2();
  EXPECT_TRUE(ProcessModel(model).readings_are_linear());
  add_effect(model, "test_eccentric_encoder", 1, {0.02});
  const ProcessModel process(model);
  EXPECT_FALSE(process.readings_are_linear());
  const Eigen::VectorXd x = some_states(process, model, 1).col(0);
  Eigen::MatrixXd H;
  const Eigen::VectorXd z = process.motor_readings(0, x, &H);
  EXPECT_EQ(z(0), x(0));
  const int angle = *process.layout().motor_angle[1];
  EXPECT_DOUBLE_EQ(z(1), x(angle) + 0.02 * std::sin(x(angle)));
  EXPECT_DOUBLE_EQ(H(1, angle), 1 + 0.02 * std::cos(x(angle)));
}

TEST_F(WithTestEffects, DelayedCommandsComeFromTheHistoryInEveryPath) {
  ArmModel model = raven2();
  add_effect(model, "test_late", 0, {0.005});
  const ProcessModel process(model);
  CommandHistory history(3, 1);
  const double before[3] = {0.05, 0, 0}, now[3] = {-0.05, 0, 0};
  history.push(0, before);
  history.push(0.009, before);
  history.push(0.010, now);
  const Step step{0.010, 1e-3, now, nullptr, &history};
  const Eigen::VectorXd x = some_states(process, model, 1).col(0);
  Eigen::VectorXd scalar = x, dual = x, undelayed = x;
  Eigen::MatrixXd lanes = x, F(12, 12);
  process.advance(step, scalar.data());
  process.advance_many(step, lanes);
  process.advance_with_jacobian(step, dual.data(), F);
  ProcessModel(raven2()).advance({0.010, 1e-3, before, nullptr, nullptr}, undelayed.data());
  for (int i = 0; i < 12; ++i) {
    EXPECT_DOUBLE_EQ(scalar(i), undelayed(i));
    EXPECT_NEAR(lanes(i, 0), scalar(i), 1e-11 * std::max(1.0, std::abs(scalar(i))));
    EXPECT_NEAR(dual(i), scalar(i), 1e-11 * std::max(1.0, std::abs(scalar(i))));
  }
}

TEST(ProcessModel, AJointWithoutMotorReadsZeroThereAlsoBesideAnEffectOfItsSensors) {
  ArmModel model = pendulum();
  model.nominal.joint[0].motor_encoder_offset = 0.3;
  add_effect(model, "encoder_eccentricity", 0, {0.02, 0.01, 1});
  const ProcessModel process(model);
  ASSERT_FALSE(process.readings_are_linear());
  const Eigen::VectorXd x = Eigen::Vector2d(0.4, -0.7);
  Eigen::VectorXd z = Eigen::VectorXd::Ones(1);
  process.read(0, x, z);
  EXPECT_EQ(z(0), 0);
  Eigen::MatrixXd H;
  EXPECT_EQ(process.motor_readings(0, x, &H)(0), 0);
  EXPECT_EQ(H, Eigen::MatrixXd::Zero(1, 2));
}

TEST(ProcessModel, HasRoomForSoManyStates) {
  ArmModel model = raven2();
  const auto states = [&model](int of_effects) {
    model.effects.assign(of_effects, place_effect(*find_effect("joint_presliding"), model.nominal, 0));
    return message_of([&model] { ProcessModel process(model); });
  };
  EXPECT_EQ(states(52), "no InputError");
  EXPECT_EQ(states(53), "arm with effects has 65 states, more than 64: place fewer effects with internal states");
}

TEST(ProcessModel, RungeKuttaIsOfFourthOrderAlsoUnderAForceThatChangesInTime) {
  ArmModel model = pendulum();
  add_effect(model, "external_force", 0, {2, 0, 3, 1, 0, 0});  // rises over three seconds, of which this sees a part
  const ProcessModel process(model);
  const auto after_half_a_second = [&](int steps) {
    Eigen::Vector2d x(1, 0);
    const double none[1] = {}, h = 0.5 / steps;
    for (int i = 0; i < steps; ++i)
      runge_kutta_4(process.transmission(), process.layout(), i * h, h, nullptr, none, none, x.data());
    return x(0);
  };
  const double exact = after_half_a_second(640);
  const double ratio = (after_half_a_second(10) - exact) / (after_half_a_second(20) - exact);
  EXPECT_NEAR(ratio, 16, 2);  // 2⁴ and the next order; 2 if a stage has another time
}

TEST(ProcessModel, SubStepsGoThroughTheTimeOfTheirStepInEveryPath) {
  constexpr double kStart = 2, kLength = 1e-3;  // s
  ArmModel model = raven2();
  add_effect(model, "cable_slip", 1, {1e-4, kStart + kLength / 2, 0});  // half of it has slipped then
  const ProcessModel process(model);
  const int parts = process.substeps(kLength);
  ASSERT_GT(parts, 1);
  const double h = kLength / parts;
  const Step step{kStart, kLength, kTorque, kLoad, nullptr};
  const Eigen::VectorXd x = some_states(process, model, 1).col(0);
  Eigen::VectorXd exact = x, scalar = x, dual = x;
  Eigen::MatrixXd lanes = x, F(12, 12);
  for (int i = 0; i < parts; ++i)
    runge_kutta_4(process.transmission(), process.layout(), kStart + i * h, h, nullptr, kTorque, kLoad, exact.data());
  process.advance(step, scalar.data());
  process.advance_many(step, lanes);
  process.advance_with_jacobian(step, dual.data(), F);
  for (int i = 0; i < 12; ++i) {
    const double rounding = 1e-11 * std::max(1.0, std::abs(exact(i)));  // as of lanes and scalars
    EXPECT_NEAR(scalar(i), exact(i), rounding) << process.state_name(i);
    EXPECT_NEAR(lanes(i, 0), exact(i), rounding) << process.state_name(i);
    EXPECT_NEAR(dual(i), exact(i), rounding) << process.state_name(i);
  }
}

}  // namespace
}  // namespace halyard
