#include "plant/integrators/integrator.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <thread>

#include "plant/equilibrium.h"
#include "plant/simulate.h"
#include "tests/plant/integrator_names.h"

// The SUNDIALS inside halyard_plant and the one of 2006 in Simbody's libraries run side by side here. The same file is
// linked a second time with Simbody's libraries before halyard's.

namespace halyard {
namespace {

Engine engine_of(IntegratorKind kind) { return kind == IntegratorKind::rosenbrock ? Engine::halyard : Engine::simbody; }

/// Experiment A without rounded readings, which turn errors of 1e-12 into other torques.
Scenario smooth_scenario(IntegratorKind kind) {
  Scenario s = read_scenario(HALYARD_SOURCE_DIR "/examples/raven2/experiment_a.xml");
  s.duration_s = 1;
  s.fade_in_s = 0.5;
  s.quantise = false;
  s.integrator.kind = kind;
  s.engine = engine_of(kind);
  return s;
}

double largest_difference(const Log& a, const Log& b, int joint) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(a.joint_position[joint][i] - b.joint_position[joint][i]));
  return largest;
}

TEST(Integrators, AllAgreeWithTheReferenceAndConvergeToIt) {
  const Log reference = simulate(smooth_scenario(IntegratorKind::bdf)).truth;
  for (const auto& [kind, name] : integrator_names()) {
    if (kind == IntegratorKind::bdf) continue;
    Scenario scenario = smooth_scenario(kind);
    const Log at_default = simulate(scenario).truth;
    for (int k = 0; k < 3; ++k) {
      // Empirical: at rtol 1e-6 the one-step methods are off by up to 6e-9 rad, CPodes, started anew a thousand times,
      // by up to 7e-6.
      const double tolerance = kind == IntegratorKind::simbody_cpodes ? 2e-5 : 2e-8;
      EXPECT_LT(largest_difference(at_default, reference, k), tolerance) << name << ", joint " << k + 1;
    }
    if (kind != IntegratorKind::dirk && kind != IntegratorKind::simbody_cpodes) continue;
    scenario.integrator.relative_tolerance = 1e-8;
    scenario.integrator.absolute_tolerance = 1e-11;
    const Log tight = simulate(scenario).truth;
    EXPECT_LT(3 * largest_difference(tight, reference, 1), largest_difference(at_default, reference, 1)) << name;
  }
}

/// The motion on the own chain with default options; the reference with Simbody and CVODE.
void expect_near_reference(Scenario scenario, const std::string& what) {
  scenario.duration_s = 0.5;
  scenario.engine = Engine::halyard;
  scenario.integrator.kind = IntegratorKind::automatic;
  const Log fast = simulate(scenario).truth;
  scenario.engine = Engine::simbody;
  scenario.integrator.kind = IntegratorKind::bdf;
  const Log reference = simulate(scenario).truth;
  for (int k = 0; k < 3; ++k) EXPECT_LT(largest_difference(fast, reference, k), 1e-6) << what << ", joint " << k + 1;
}

TEST(Integrators, OfTheOwnChainStayWithTheReferenceOfAStifferArm) {
  Scenario scenario = smooth_scenario(IntegratorKind::rosenbrock);
  ArmParameters<double>& arm = scenario.robot.nominal;
  arm.joint[0].stiffness *= 100, arm.joint[0].damping *= 100;
  expect_near_reference(scenario, "stiff");
  for (int k = 0; k < 3; ++k) arm.joint[k].joint_smoothing /= 10, arm.joint[k].motor_smoothing /= 10;
  expect_near_reference(scenario, "sharp");
  for (JointTrajectory& t : scenario.trajectory) t.sines.clear();
  expect_near_reference(scenario, "at rest");
}

TEST(Integrators, OfSimbodysChainStayWithTheReferenceOfAStifferArm) {
  Scenario scenario = smooth_scenario(IntegratorKind::automatic);
  scenario.engine = Engine::simbody;
  scenario.duration_s = 0.3;
  for (int k = 0; k < 3; ++k) {
    JointParameters<double>& j = scenario.robot.nominal.joint[k];
    if (k == 0) j.stiffness *= 100, j.damping *= 100;
    j.joint_smoothing /= 10, j.motor_smoothing /= 10;
  }
  const SimulationResult fast = simulate(scenario);
  scenario.integrator.kind = IntegratorKind::bdf;
  const Log reference = simulate(scenario).truth;
  for (int k = 0; k < 3; ++k) EXPECT_LT(largest_difference(fast.truth, reference, k), 1e-6) << "joint " << k + 1;
  // One step of six stages in most ticks; dirk needs 13 derivatives a tick.
  EXPECT_LT(fast.derivative_evaluations, 300 * 10);
}

TEST(Integrators, OfTheOwnChainStayWithTheReferenceWithEffects) {
  for (const char* name : {"backlash", "hysteresis", "delay", "torque_ripple", "external_force", "stribeck"}) {
    Scenario scenario = smooth_scenario(IntegratorKind::rosenbrock);
    scenario.robot.effects = {place_effect(*find_effect(name), scenario.robot.nominal, 1)};
    expect_near_reference(scenario, name);
  }
}

TEST(Integrators, OfSundialsAndOfSimbodyTakeTurnsInOneProcess) {
  const Scenario scenario = smooth_scenario(IntegratorKind::bdf);
  const std::vector<double> command = {0.02, 0.03, -0.01}, no_load = {0, 0, 0};
  std::vector<std::unique_ptr<ArmPlant>> plants;
  std::vector<std::unique_ptr<Integrator>> integrators;
  for (const auto& [kind, name] : integrator_names()) {
    plants.push_back(std::make_unique<ArmPlant>(scenario.robot.nominal, scenario.robot.effects, engine_of(kind)));
    const Eigen::VectorXd start = resting_state(*plants.back(), 0, scenario.robot.home());
    IntegratorOptions options{kind, 1e-7, 1e-10};
    integrators.push_back(make_integrator(*plants.back(), options, 0, start));
    plants.back()->set_inputs(0, command.data(), no_load.data());
  }
  const Eigen::VectorXd start = integrators[0]->state();
  for (int tick = 1; tick <= 100; ++tick)
    for (const auto& integrator : integrators) integrator->advance(0.001 * tick);
  const auto reference = std::distance(integrator_names().begin(), integrator_names().find(IntegratorKind::bdf));
  EXPECT_GT((integrators[reference]->state() - start).head(3).norm(), 1e-3);  // it moved
  // Empirical: CPodes is off by 1.3e-6 rad, the others by less than 1e-8.
  for (std::size_t i = 0; i < integrators.size(); ++i)
    EXPECT_LT((integrators[i]->state() - integrators[reference]->state()).head(3).norm(), 5e-6) << i;
}

TEST(Integrators, StandSharpFrictionInStick) {
  // tanh(v / 1e-3) at the joints and at the motors: eigenvalues of -1e4 and -3e5 per second.
  for (const IntegratorKind kind : {IntegratorKind::rosenbrock, IntegratorKind::dirk, IntegratorKind::imex}) {
    Scenario scenario = smooth_scenario(kind);
    scenario.duration_s = 0.3;
    for (JointTrajectory& t : scenario.trajectory) t.sines.clear();
    for (int k = 0; k < 3; ++k) {
      scenario.robot.nominal.joint[k].motor_smoothing = 1e-3;
      scenario.robot.nominal.joint[k].joint_smoothing = 1e-3;
    }
    const SimulationResult result = simulate(scenario);
    scenario.integrator.kind = IntegratorKind::bdf;
    scenario.engine = Engine::simbody;
    const Log reference = simulate(scenario).truth;
    for (int k = 0; k < 3; ++k) EXPECT_LT(largest_difference(result.truth, reference, k), 1e-8);
    // An explicit method needs a step of 1e-5 s here, 400 derivatives a tick of 1 ms.
    EXPECT_LT(result.derivative_evaluations, 300 * 50);
  }
}

TEST(Integrators, OfOneThreadEachGiveWhatTheyGiveAlone) {
  Scenario scenario = smooth_scenario(IntegratorKind::dirk);
  scenario.duration_s = 0.3;
  const Log alone = simulate(scenario).truth;
  std::vector<Log> logs(2);
  std::vector<std::thread> threads;
  for (Log& log : logs) threads.emplace_back([&log, scenario] { log = simulate(scenario).truth; });
  for (std::thread& thread : threads) thread.join();
  for (const Log& log : logs) {
    EXPECT_EQ(log.joint_position, alone.joint_position);
    EXPECT_EQ(log.motor_position, alone.motor_position);
  }
}

/// A force that is lost after 50 ms.
class LostForce : public EffectOf<LostForce> {
 public:
  std::string name() const override { return "lost_force"; }
  std::string summary() const override { return "a force that is no number after 50 ms"; }
  unsigned stages() const override { return static_cast<unsigned>(EffectStage::joint); }
  std::vector<EffectParameter> parameters(const ArmParameters<double>&, EffectPlace) const override { return {}; }
  template <class T>
  void on_joint(const EffectContext<T>& c, JointSignals<T>* s) const {
    if (c.time > 0.05) s[*c.joint].joint_force = T(std::numeric_limits<double>::quiet_NaN());
  }
};

TEST(Integrators, NameTheTimeAtWhichTheyFail) {
  const LostForce effect;
  for (const auto& [kind, name] : integrator_names()) {
    Scenario scenario = smooth_scenario(kind);
    scenario.robot.effects.push_back({&effect, 0, {}});
    try {
      simulate(scenario);
      ADD_FAILURE() << name << " went on";
    } catch (const std::runtime_error& error) {
      const std::string what = error.what(),
                        start = "scenario '" + scenario.name + "': integration failed between t = 0.05";
      EXPECT_TRUE(what.starts_with(start) && what.ends_with("or set other tolerances")) << name << ": " << what;
      EXPECT_EQ(what.find('\n'), what.npos) << name;
    }
  }
}

}  // namespace
}  // namespace halyard
