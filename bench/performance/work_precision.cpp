#include "bench/performance/work_precision.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "bench/bench_arm.h"
#include "bench/thread_time.h"

namespace halyard {
namespace {

constexpr double kTolerances[] = {1e-4, 1e-6, 1e-8};
constexpr int kRepeats = 2;               // of each run; the shorter time counts
constexpr double kLeastError = 1e-13;     // rad | m: what rounding leaves
constexpr double kNoiseOfFriction = 0.1;  // torque noise at rest

struct Named {
  const char* name;
  IntegratorKind kind;
  Engine engine;
};

constexpr Named kCompared[] = {
    {"rosenbrock", IntegratorKind::rosenbrock, Engine::halyard},
    {"dirk", IntegratorKind::dirk, Engine::halyard},
    {"imex", IntegratorKind::imex, Engine::halyard},
    {"imex_link1", IntegratorKind::imex_link1, Engine::halyard},
    {"explicit_rk", IntegratorKind::explicit_rk, Engine::halyard},
    {"dirk, Simbody", IntegratorKind::dirk, Engine::simbody},
    {"simbody_rkm", IntegratorKind::simbody_rkm, Engine::simbody},
    {"simbody_cpodes", IntegratorKind::simbody_cpodes, Engine::simbody},
};

}  // namespace

Scenario scenario_of(const StiffCase& which, double duration_s) {
  ArmModel arm = raven2();
  arm.nominal.joint[0].stiffness *= which.stiffness;
  arm.nominal.joint[0].damping *= which.stiffness;
  for (int k = 0; k < arm.n(); ++k) {
    arm.nominal.joint[k].motor_smoothing *= which.smoothing;
    arm.nominal.joint[k].joint_smoothing *= which.smoothing;
  }
  Scenario s = sines(arm, duration_s);
  s.fade_in_s = 0.1;
  s.quantise = false;  // a reading that rounds to another count would hide the integrator's error
  if (!which.resting) return s;
  for (int k = 0; k < arm.n(); ++k) {
    s.trajectory[k].kind = JointTrajectory::Kind::hold;
    s.noise.motor_torque.push_back(kNoiseOfFriction * arm.nominal.joint[k].motor_coulomb);
  }
  return s;
}

double largest_difference(const Log& a, const Log& b) {
  double largest = kLeastError;
  for (int k = 0; k < a.n_joints; ++k)
    for (std::size_t i = 0; i < a.size(); ++i)
      largest = std::max(largest, std::abs(a.joint_position[k][i] - b.joint_position[k][i]));
  return largest;
}

Log reference(Scenario scenario) {
  scenario.engine = Engine::halyard;
  scenario.integrator.kind = IntegratorKind::bdf;
  return simulate(scenario).truth;
}

std::vector<std::string> compared_integrators() {
  std::vector<std::string> names;
  for (const Named& each : kCompared) names.emplace_back(each.name);
  return names;
}

std::vector<WorkPrecision> measure(const StiffCase& which, double duration_s) {
  Scenario s = scenario_of(which, duration_s);
  const Log exact = reference(s);
  std::vector<WorkPrecision> all;
  for (const Named& each : kCompared) {
    WorkPrecision result{each.name, {}};
    s.engine = each.engine;
    for (const double tolerance : kTolerances) {
      s.integrator = {each.kind, tolerance, 1e-3 * tolerance};
      try {
        double seconds = std::numeric_limits<double>::infinity();
        Log truth(0);
        for (int repeat = 0; repeat < kRepeats; ++repeat) {
          const double before = thread_time_s();
          truth = simulate(s).truth;
          seconds = std::min(seconds, thread_time_s() - before);
        }
        result.points.push_back({largest_difference(truth, exact), 1e3 * seconds / duration_s});
        if (seconds > kLongestRun) break;
      } catch (const std::runtime_error&) {
        break;
      }
    }
    all.push_back(result);
  }
  return all;
}

double work_at(const WorkPrecision& integrator, double error) {
  const std::vector<WorkPoint>& p = integrator.points;
  if (!p.empty() && p[0].error <= error) return p[0].work_ms;
  for (std::size_t i = 1; i < p.size(); ++i) {
    if (p[i].error > error) continue;
    const double share = std::log(p[i - 1].error / error) / std::log(p[i - 1].error / p[i].error);
    return p[i - 1].work_ms * std::pow(p[i].work_ms / p[i - 1].work_ms, share);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace halyard
