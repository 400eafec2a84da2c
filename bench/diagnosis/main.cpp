/// halyard_blind_trials: the diagnosis' test of itself, see bench/README.md.

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <glog/logging.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for_each.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <set>

#include "app/interruption.h"
#include "bench/diagnosis/results/scoring.h"
#include "bench/diagnosis/summary/read_trials.h"
#include "bench/diagnosis/summary/summary.h"
#include "bench/diagnosis/trial/trial.h"
#include "bench/program.h"
#include "diagnosis/judgement/decision_rule.h"
#include "model/model_file.h"
#include "model/output/folder_lock.h"

namespace halyard::blind {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<int> rows;
  std::vector<std::string> kinds, sensors = {"good"};
  int off = 1;
  std::string arms = "mixed";
  int trials = 20;
  std::vector<std::string> rules;
  TrialOptions trial;
  fs::path out;
  std::string shard = "1/1";
  bool resume = false;
  std::vector<fs::path> known;
  int threads = 0;
  std::vector<fs::path> summary;
};

struct Job {
  Situation situation;
  int index;
};

std::vector<Situation> situations_of(const Options& options) {
  const Arms arms = arms_of(options.arms);
  std::vector<Situation> all;
  const auto add = [&](const Situation& s) {
    if (std::ranges::find(all, s) == all.end()) all.push_back(s);
  };
  for (const int row : options.rows)
    for (const Situation& s : situations_of_row(row, arms)) add(s);
  for (const std::string& kind : options.kinds)
    for (const std::string& sensors : options.sensors) add({kind_of(kind), sensors_of(sensors), options.off, arms});
  if (all.empty()) throw InputError("--row, --kind: both are missing; give --row 1, for example");
  return all;
}

std::vector<Job> jobs_of(const Options& options) {
  int part = 0, parts = 0;
  char rest = 0;
  if (std::sscanf(options.shard.c_str(), "%d/%d%c", &part, &parts, &rest) != 2 || part < 1 || part > parts)
    throw InputError("--shard: " + in_quotes(options.shard) + ": expected i/n with i from 1 to n, such as 2/5");
  const std::vector<Situation> situations = situations_of(options);
  std::vector<Job> jobs;
  // A run that is stopped early has some of each situation.
  for (int i = part - 1; i < options.trials; i += parts)
    for (const Situation& situation : situations) jobs.push_back({situation, i});
  return jobs;
}

bool is_of_other_options(const Result& r, const TrialOptions& trial) {
  return r.seed != trial.seed || r.outliers != trial.outliers || r.rule != trial.rule;
}

/// The file names of the results that --known has. Throws InputError if they are of other options.
std::set<fs::path> known_results(const Options& options) {
  std::set<fs::path> known;
  if (options.known.empty()) return known;
  for (const Result& r : read_trials(options.known)) {
    if (is_of_other_options(r, options.trial))
      throw InputError(options.known[0].string() + ": is of another --seed, --outliers or --rule; give those");
    known.insert(result_path(options.out, r.situation, r.index));
  }
  return known;
}

/// Jobs that have no result yet. Throws InputError if there is one of other options.
std::vector<Job> jobs_left(const Options& options) {
  const std::set<fs::path> known = known_results(options);
  std::vector<Job> left;
  for (const Job& job : jobs_of(options)) {
    const fs::path path = result_path(options.out, job.situation, job.index);
    if (known.contains(path)) continue;
    if (!options.resume || !fs::exists(path)) {
      left.push_back(job);
      continue;
    }
    if (is_of_other_options(read_result(path), options.trial))
      throw InputError(
          path.string() +
          ": is of another --seed, --outliers or --rule; give those, leave out --resume, or take another folder");
  }
  return left;
}

/// Varies the thresholds, each given as NAME=VALUE.
void vary_rules(const std::vector<std::string>& rules) {
  for (const std::string& rule : rules) {
    const std::size_t equals = rule.find('=');
    double value = 0;
    if (equals == std::string::npos || !CLI::detail::lexical_cast(rule.substr(equals + 1), value))
      throw InputError("--rule: " + in_quotes(rule) + ": expected NAME=VALUE, such as sure_name=0.5");
    try {
      vary_rule(rule.substr(0, equals), value);
    } catch (const std::invalid_argument& error) {
      throw InputError("--rule: " + std::string(error.what()));
    }
  }
}

std::string line(const Result& r) {
  std::string truth, named = r.failure.empty() ? r.verdict : r.failure;
  for (const TrueEffect& t : r.truth)
    truth += fmt::format(" {}{} (seen from {:.3g} of it, named from {:.3g})", label(t.place),
                         t.form.empty() ? "" : " as " + t.form, t.seen_from, t.named_from);
  for (const Named& n : r.named) named += ", " + label(n.place);
  const char* score = strictly_right(r) ? ": strictly right" : loosely_right(r) ? ": loosely right" : "";
  return fmt::format("{}-{:06}, {} of {} joints, {:.0f} s:{} -> {}{}", label(r.situation), r.index, r.arm, r.joints,
                     r.wall_s, truth.empty() ? " nothing" : truth, named, score);
}

void run(const Options& options) {
  std::string part = options.shard;
  std::ranges::replace(part, '/', '-');
  const FolderLock lock(options.out, part);
  const ArmModel raven2 = read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml");
  const std::vector<Job> jobs = jobs_left(options);
  const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  std::mutex one_at_a_time;
  tbb::task_arena outer(threads);
  outer.execute([&] {
    tbb::parallel_for_each(jobs, [&](const Job& job) {
      // A trial stays on one thread: its own loops give way to other trials, and its processor time can be told.
      tbb::task_arena alone(1);
      const Result r = alone.execute([&] { return run_trial(raven2, job.situation, job.index, options.trial); });
      write_result(options.out, r);
      const std::lock_guard<std::mutex> lock(one_at_a_time);
      fmt::print("{}\n", line(r));
      std::fflush(stdout);
    });
  });
}

void summarise(const Options& options) {
  const std::vector<Result> results = read_trials(options.summary);
  const fs::path& first = options.summary[0];
  const fs::path out = !options.out.empty() ? options.out : fs::is_directory(first) ? first : first.parent_path();
  fmt::print("{}{}\n", write_summary(out, results), (out / "summary.md").string());
}

void add_situation_options(CLI::App& app, Options& options) {
  app.add_option("--row", options.rows, "all situations of this row of the acceptance table; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--kind", options.kinds, fmt::format("{}; may be repeated", fmt::join(kind_words(), ", ")))
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--sensors", options.sensors,
                 fmt::format("of --kind: {}; may be repeated", fmt::join(sensor_words(), ", ")))
      ->take_all()
      ->allow_extra_args(false)
      ->capture_default_str();
  app.add_option("--off", options.off, "of --kind: largest error of the model's numbers, in tolerances")
      ->check(CLI::Range(0, 2))
      ->capture_default_str();
  app.add_option("--arms", options.arms, fmt::format("{}", fmt::join(arm_words(), ", ")))->capture_default_str();
}

/// CLI::Range lets it pass.
std::string not_nan(const std::string& text) {
  double number = 0;
  const bool is_nan = CLI::detail::lexical_cast(text, number) && std::isnan(number);
  return is_nan ? text + ": expected a number" : "";
}

int run_command_line(int argc, char** argv) {
  CLI::App app("Blind trials of the diagnosis: the truth is hidden, diagnose() is asked.");
  Options options;
  add_situation_options(app, options);
  app.add_option("--trials", options.trials, "trials of each situation")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--seed", options.trial.seed, "seed of all")->capture_default_str();
  app.add_option("--outliers", options.trial.outliers, "share of the joint readings that are wrong")
      ->check(CLI::Range(0.0, 0.5) & CLI::Validator(not_nan, "", "a number"))
      ->capture_default_str();
  app.add_option("--rule", options.rules, "another value of a threshold in decision_rule.h; may be repeated")
      ->type_name("NAME=VALUE")
      ->take_all()
      ->allow_extra_args(false);
  app.add_option("--out", options.out, "folder of the results");
  app.add_option("--logs", options.trial.logs,
                 "keep models, truths and logs in this folder, to diagnose one of them by hand");
  app.add_option("--shard", options.shard, "run part i of n")->type_name("i/n");
  app.add_flag("--resume", options.resume, "keep what is there, run the rest");
  app.add_option("--known", options.known, "trials that these folders or trials.jsonl have are not run again")
      ->type_name("DIR|FILE...");
  app.add_option("--threads", options.threads, "trials at a time; default: one per core")->check(CLI::Range(1, 1024));
  app.add_option("--summary", options.summary,
                 "no trials: summarise those of these folders or trials.jsonl, in --out or the first of them")
      ->type_name("DIR|FILE...");
  return run_program(app, argc, argv, [&] {
    if (!options.summary.empty()) {
      summarise(options);
    } else if (options.out.empty()) {
      throw InputError("--out: is missing; give the folder of the results");
    } else {
      vary_rules(options.rules);
      options.trial.rule = fmt::format("{}", fmt::join(options.rules, " "));
      run(options);
    }
    return 0;
  });
}

}  // namespace
}  // namespace halyard::blind

int main(int argc, char** argv) {
  halyard::end_cleanly_on_signals();
  // Ceres writes to the log of why a fit gives up; what it came to is in the results.
  FLAGS_minloglevel = google::GLOG_FATAL;
  return halyard::blind::run_command_line(argc, argv);
}
