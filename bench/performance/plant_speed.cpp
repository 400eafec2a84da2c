#include "bench/performance/plant_speed.h"

#include <algorithm>
#include <limits>

#include "bench/performance/work_precision.h"
#include "bench/thread_time.h"
#include "plant/simulate.h"

namespace halyard {
namespace {

constexpr int kRepeats = 5;

struct Case {
  const char* name;
  StiffCase which;
  bool noise;
};

constexpr Case kCases[] = {
    {"moving", {1, 1, false}, false},          {"moving, stiff", {100, 1, false}, false},
    {"moving, sharp", {1, 0.1, false}, false}, {"at rest", {1, 1, true}, false},
    {"at rest, sharp", {1, 0.1, true}, false}, {"at rest, sharp, under noise", {1, 0.1, true}, true}};

struct Speed {
  double seconds = std::numeric_limits<double>::infinity();
  double error = 0;
};

}  // namespace

std::vector<PlantSpeed> time_plant(double duration_s) {
  std::vector<PlantSpeed> all;
  for (const Case& c : kCases) {
    Scenario s = scenario_of(c.which, duration_s);
    if (!c.noise) s.noise.motor_torque.clear();
    const Log exact = reference(s);
    Speed own, simbody;
    for (int repeat = 0; repeat < kRepeats; ++repeat)
      for (const auto& [engine, speed] : {std::pair(Engine::halyard, &own), std::pair(Engine::simbody, &simbody)}) {
        s.engine = engine;
        s.integrator = IntegratorOptions{};
        const double before = thread_time_s();
        const Log truth = simulate(s).truth;
        speed->seconds = std::min(speed->seconds, thread_time_s() - before);
        speed->error = largest_difference(truth, exact);
      }
    all.push_back({c.name, duration_s / own.seconds, duration_s / simbody.seconds, own.error, simbody.error});
  }
  return all;
}

}  // namespace halyard
