/// halyard_blind_trials: the diagnosis' test of itself, see bench/README.md.

#include <fmt/core.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for_each.h>
#include <tbb/task_arena.h>

#include <cstdio>
#include <mutex>

#include "bench/diagnosis/summary.h"
#include "bench/diagnosis/trial.h"
#include "bench/program.h"
#include "model/model_file.h"

namespace halyard::blind {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> kinds = {"all"};
  int trials = 20;
  TrialOptions trial;
  fs::path out;
  std::string shard = "1/1";
  bool resume = false;
  int threads = 0;
  std::vector<fs::path> summary;
};

struct Job {
  Kind kind;
  int index;
};

std::vector<Job> jobs_of(const Options& options) {
  int part = 0, parts = 0;
  char rest = 0;
  if (std::sscanf(options.shard.c_str(), "%d/%d%c", &part, &parts, &rest) != 2 || part < 1 || part > parts)
    throw InputError("--shard: " + in_quotes(options.shard) + ": expected i/n with i from 1 to n, such as 2/5");
  std::vector<Kind> kinds;
  for (const std::string& text : options.kinds)
    for (int k = 0; k < kKinds; ++k)
      if (text == "all" || kind_of(text) == static_cast<Kind>(k)) kinds.push_back(static_cast<Kind>(k));
  std::vector<Job> jobs;
  // A run that is stopped early has some of each kind.
  for (int i = part - 1; i < options.trials; i += parts)
    for (const Kind kind : kinds) jobs.push_back({kind, i});
  return jobs;
}

/// Jobs that have no result yet. Throws InputError if there is one of other options.
std::vector<Job> jobs_left(const Options& options) {
  std::vector<Job> left;
  for (const Job& job : jobs_of(options)) {
    const fs::path path = result_path(options.out, job.kind, job.index);
    if (!options.resume || !fs::exists(path)) {
      left.push_back(job);
      continue;
    }
    const Result r = read_result(path);
    if (r.seed != options.trial.seed || r.limit != options.trial.limit)
      throw InputError(path.string() +
                       ": is of another --seed or --limit; give those, leave out --resume, or take another folder");
  }
  return left;
}

std::string line(const Result& r) {
  std::string truth, named = r.failure.empty() ? r.verdict : r.failure;
  for (const TrueEffect& t : r.truth)
    truth += fmt::format(" {}{} (strength {:.3g})", label(t.place), t.form.empty() ? "" : " as " + t.form, t.strength);
  for (const Named& n : r.named) named += ", " + label(n.place);
  return fmt::format("{}-{:06}:{} -> {}{}", word(r.kind), r.index, truth.empty() ? " nothing" : truth, named,
                     is_right(r) ? ": right" : "");
}

ArmModel raven2() { return read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml"); }

void run(const Options& options) {
  const ArmModel model = raven2();
  const std::vector<Job> jobs = jobs_left(options);
  const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  std::mutex one_at_a_time;
  tbb::task_arena outer(threads);
  outer.execute([&] {
    tbb::parallel_for_each(jobs, [&](const Job& job) {
      // A trial stays on one thread: its own loops give way to other trials, and its processor time can be told.
      tbb::task_arena alone(1);
      const Result r = alone.execute([&] { return run_trial(model, job.kind, job.index, options.trial); });
      write_result(options.out, r);
      const std::lock_guard<std::mutex> lock(one_at_a_time);
      fmt::print("{}\n", line(r));
      std::fflush(stdout);
    });
  });
}

void summarise(const Options& options) {
  std::vector<fs::path> paths;
  for (const fs::path& folder : options.summary) {
    if (!fs::is_directory(folder / "trials"))
      throw InputError(folder.string() + ": holds no trials; give the folder of an earlier --out");
    for (const auto& entry : fs::directory_iterator(folder / "trials"))
      if (entry.path().extension() == ".json") paths.push_back(entry.path());
  }
  std::ranges::sort(paths, {}, [](const fs::path& p) { return p.filename(); });
  std::vector<Result> results;
  for (const fs::path& path : paths) results.push_back(read_result(path));
  const fs::path out = options.out.empty() ? options.summary[0] : options.out;
  write_summary(out, results, raven2().nominal, options.trial.limit);
  fmt::print("{}\n", (out / "summary.md").string());
}

int run_command_line(int argc, char** argv) {
  CLI::App app("Blind trials of the diagnosis: the truth is hidden, diagnose() is asked.");
  Options options;
  app.add_option(
         "--kind", options.kinds,
         "clean_exact, clean_mistuned, effect, effect_mistuned, form, outside, pair, each_effect or all; may be "
         "repeated")
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--trials", options.trials, "trials of each kind")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--seed", options.trial.seed, "seed of all")->capture_default_str();
  app.add_option("--limit", options.trial.limit, "strength above which an effect counts")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--out", options.out, "folder of the results");
  app.add_option("--logs", options.trial.logs, "keep the logs in this folder, to diagnose one of them by hand");
  app.add_option("--shard", options.shard, "run part i of n")->type_name("i/n");
  app.add_flag("--resume", options.resume, "keep what is there, run the rest");
  app.add_option("--threads", options.threads, "trials at a time; default: one per core")->check(CLI::Range(1, 1024));
  app.add_option("--summary", options.summary,
                 "no trials: sum up those of these folders, into --out or the first of them")
      ->type_name("DIR...");
  return run_program(app, argc, argv, [&] {
    if (!options.summary.empty()) {
      summarise(options);
    } else if (options.out.empty()) {
      throw InputError("--out: is missing; give the folder of the results");
    } else {
      run(options);
    }
    return 0;
  });
}

}  // namespace
}  // namespace halyard::blind

int main(int argc, char** argv) { return halyard::blind::run_command_line(argc, argv); }
