/// Writes docs/performance.md and its diagrams: times as ratios within this run.

#include <fmt/format.h>

#include "bench/performance/diagram.h"
#include "bench/performance/filter_costs.h"
#include "bench/performance/filter_steps.h"
#include "bench/performance/page.h"
#include "bench/program.h"
#include "model/output/output_files.h"

namespace halyard {
namespace {

constexpr double kStiffness[] = {1, 10, 100}, kSmoothing[] = {1, 0.1, 0.02};

std::vector<Panel> measure_panels(bool resting, double duration_s) {
  std::vector<Panel> panels;
  for (const double smoothing : kSmoothing)
    for (const double stiffness : kStiffness) {
      const StiffCase which{stiffness, smoothing, resting};
      panels.push_back({which, measure(which, duration_s)});
      fmt::print("stiffness x{}, smoothing x{}, {}\n", stiffness, smoothing, resting ? "at rest" : "moving");
      std::fflush(stdout);
    }
  return panels;
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  write_file_whole(path, text);
}

}  // namespace
}  // namespace halyard

int main(int argc, char** argv) {
  using namespace halyard;
  CLI::App app("Times as ratios: writes performance.md and its diagrams");
  std::filesystem::path out = HALYARD_SOURCE_DIR "/docs";
  double duration_s = 0.2;
  int rounds = 3;
  app.add_option("--out", out, "folder of performance.md and images/");
  app.add_option("--duration", duration_s, "simulated time of each run of an integrator, s")
      ->check(CLI::Range(0.02, 10.0));
  app.add_option("--rounds", rounds, "how often the filters run over their record")->check(CLI::Range(1, 1000));
  return run_program(app, argc, argv, [&] {
    constexpr double kSimulated = 2;  // s
    Measured m{time_estimators(rounds), time_chains(rounds), time_filters(rounds), time_plant(kSimulated), {}, {}};
    m.moving = measure_panels(false, duration_s);
    m.resting = measure_panels(true, duration_s);
    const std::size_t columns = std::size(kStiffness);
    write(out / "images/work_precision_moving.svg", diagram_svg("Moving", m.moving, columns));
    write(out / "images/work_precision_resting.svg", diagram_svg("At rest", m.resting, columns));
    write(out / "performance.md", page(m));
    fmt::print("{}\n", (out / "performance.md").string());
    return 0;
  });
}
