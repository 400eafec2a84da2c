/// halyard_identify_coverage: how often the intervals of `identify` hold the truth, see bench/README.md.

#include <fmt/core.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <cstdio>
#include <map>

#include "bench/diagnosis/draw/motion.h"
#include "bench/diagnosis/results/proportion.h"
#include "bench/program.h"
#include "estimators/identification/identify.h"
#include "evaluation/comparison/assumed_noise.h"
#include "model/model_file.h"
#include "model/statistics/quantile.h"
#include "plant/simulate.h"

namespace halyard::blind {
namespace {

/// What of the true robot is off beside the numbers that are asked for, uniformly within its tolerance.
enum class Off { nothing, stiffness, everything };

struct Options {
  int runs = 50;
  std::uint64_t seed = 1;
  double seconds = 20;
  std::string parameters = "coupling";
  std::string model = HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml";
  Off off = Off::nothing;
  int threads = 0;
};

struct Outcome {
  std::string name, unit;
  double nominal = 0, truth = 0, value = 0, lower = 0, upper = 0;
  bool in_interval() const { return lower <= truth && truth <= upper; }
};

/// Numbers of the truth: those that are asked for up to 15 % from the model's.
void draw_truth(ArmModel& robot, const std::vector<std::string>& keys, Off off, Random& random) {
  for (const ParameterInfo& info : named_parameters(robot.nominal)) {
    // identify() takes these as exact.
    if (info.tolerance == &Tolerances::com || info.tolerance == &Tolerances::inertia ||
        info.tolerance == &Tolerances::smoothing)
      continue;
    const double u = random.uniform(-1, 1);
    if (info.key.ends_with(".gear_ratio") || info.key.ends_with(".pulley_radius")) continue;  // the capstan tells it
    const bool stiffness = info.key.ends_with("cable.stiffness") || info.key.ends_with("cable.damping");
    if (std::ranges::find(keys, info.key) != keys.end()) info.number.set(info.number.get() * (1 + 0.15 * u));
    else if (off == Off::everything || (off == Off::stiffness && stiffness))
      info.number.set(info.number.get() + std::copysign(robot.reach(info), info.number.get()) * u);
  }
}

std::vector<Outcome> run_one(const ArmModel& model, const Options& options, int index) {
  Random random(options.seed, 0x1de7, static_cast<std::uint32_t>(index));
  const std::vector<std::string> keys = identified_keys(model, options.parameters);
  Scenario s;
  s.name = fmt::format("run {}", index);
  s.robot = model;
  for (JointParameters<double>& j : s.robot.nominal.joint) j.motor_encoder_noise = 0;  // in the noise that is drawn
  draw_truth(s.robot, keys, options.off, random);
  for (JointDescription& j : s.robot.joints) j.controller.kp *= 2.5, j.controller.kd *= 2;
  s.assumed = model;
  s.duration_s = options.seconds;
  s.trajectory = random_motion(model, random);
  s.noise = assumed_noise(model, s.control_period_s, random.uniform(0, 1));
  s.seed = random.seed();
  const Identification found = identify(model, {simulate(s).measured}, keys);
  std::vector<Outcome> outcomes;
  for (const IdentifiedNumber& number : found.numbers)
    outcomes.push_back({number.name, number.unit, number.nominal, find_number(s.robot.nominal, number.key).get(),
                        number.value, number.lower, number.upper});
  return outcomes;
}

void run(const Options& options) {
  const ArmModel model = read_model(options.model);
  const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  std::vector<std::vector<Outcome>> runs(options.runs);
  tbb::parallel_for(0, options.runs, [&](int i) {
    runs[i] = run_one(model, options, i);
    std::string line = fmt::format("run {}:", i);
    for (const Outcome& o : runs[i])
      line += fmt::format(" {:+.2g} of {:.2g} %{}", 100 * (o.value - o.truth) / o.nominal,
                          50 * (o.upper - o.lower) / std::abs(o.nominal), o.in_interval() ? "," : " missed,");
    fmt::print(stderr, "{}\n", line);
  });

  fmt::print("| number | held in its 95 % interval | share | Clopper-Pearson 95 % | median half width | RMS error |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  Proportion all;
  for (std::size_t p = 0; p < runs[0].size(); ++p) {
    Proportion share;
    std::vector<double> width;
    double square = 0;
    for (const auto& outcomes : runs) {
      const Outcome& o = outcomes[p];
      share.count(o.in_interval());
      all.count(o.in_interval());
      width.push_back((o.upper - o.lower) / 2 / std::abs(o.nominal));
      square += std::pow((o.value - o.truth) / o.nominal, 2);
    }
    fmt::print("| {} | {} | {:.2g} % | {:.2g} % |\n", runs[0][p].name, share.cells(), 100 * median(width),
               100 * std::sqrt(square / options.runs));
  }
  fmt::print("| all | {} | | |\n", all.cells());
  std::fflush(stdout);
}

int run_command_line(int argc, char** argv) {
  CLI::App app("Intervals of halyard identify against the truth, over simulated logs.");
  Options options;
  const std::map<std::string, Off> words = {
      {"nothing", Off::nothing}, {"stiffness", Off::stiffness}, {"everything", Off::everything}};
  app.add_option("--runs", options.runs, "logs")->check(CLI::Range(2, 100000))->capture_default_str();
  app.add_option("--seed", options.seed, "seed of all")->capture_default_str();
  app.add_option("--seconds", options.seconds, "of a log")->check(CLI::Range(3.0, 1e4))->capture_default_str();
  app.add_option("--model", options.model, "model file; default: the RAVEN-II");
  app.add_option("--parameters", options.parameters, "as halyard identify takes them")->capture_default_str();
  app.add_option("--off", options.off, "what else is off, within its tolerance: nothing, stiffness, everything")
      ->transform(CLI::CheckedTransformer(words));
  app.add_option("--threads", options.threads, "runs at a time; default: one per core")->check(CLI::Range(1, 1024));
  return run_program(app, argc, argv, [&] {
    run(options);
    return 0;
  });
}

}  // namespace
}  // namespace halyard::blind

int main(int argc, char** argv) { return halyard::blind::run_command_line(argc, argv); }
