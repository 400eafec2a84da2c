#include "app/commands/identify_command.h"

#include <fmt/format.h>

#include <cmath>

#include "app/log_input.h"
#include "app/output_check.h"
#include "app/pages/identify_output.h"
#include "app/progress.h"
#include "diagnosis/record.h"
#include "evaluation/joint_unit.h"
#include "model/input_error.h"
#include "model/model_file.h"

namespace halyard {
namespace {

constexpr const char* kEstimators[] = {"kinematics", "sr_ukf"};

std::string names_of(const std::vector<Log>& logs) {
  std::string names;
  for (const Log& log : logs) names += (names.empty() ? "" : ", ") + log.source;
  return names;
}

void print(const IdentifyResult& result) {
  for (const IdentifiedNumber& number : result.identification.numbers)
    fmt::print("{}: {:.5g} -> {:.7g}{} (95 %: {:.7g} to {:.7g}), {}\n", number.name, number.nominal, number.value,
               number.unit == "1" ? "" : " " + number.unit, number.lower, number.upper, in_words(number.convergence));
  for (const std::string& doubt : doubts(result)) fmt::print("note: {}\n", doubt);
  const std::vector<JointUnit> units = joint_units(result.given);
  for (const EstimatorComparison& e : result.estimators)
    for (int k = 0; k < result.given.n(); ++k)
      if (!e.before.rms.empty() && !e.after.rms.empty() && std::isfinite(e.before.rms[k]))
        fmt::print("  joint {} {} position RMS on the hold-out: {:.4g} -> {:.4g} {}\n", k + 1, e.name,
                   units[k].shown_per_si * e.before.rms[k], units[k].shown_per_si * e.after.rms[k], units[k].shown);
}

}  // namespace

void run_identify(const IdentifyCommandOptions& options) {
  check_output_folder(options.out);
  IdentifyResult result;
  result.given = read_model(options.model);
  const std::vector<std::string> keys = identified_keys(result.given, options.parameters);
  std::vector<std::filesystem::path> paths = options.data;
  if (!options.holdout.empty()) paths.push_back(options.holdout);
  check_given_once(paths);
  std::vector<Log> logs;
  std::string notes;
  for (const auto& path : paths) {
    logs.push_back(read_log_of(result.given, path, options.columns));
    if (const std::string note = ignored_columns_note(logs.back()); !note.empty()) notes += note + "\n";
  }
  std::vector<Log> training;
  std::vector<HeldOutLog> held_out;
  if (options.holdout.empty()) {
    for (const Log& log : logs) {
      auto [first, last] = split_log(log, 2.0 / 3);
      if (last.size() > 0) held_out.push_back({&log, last.time.front()});
      training.push_back(std::move(first));
    }
    result.holdout = "the last third of " + names_of(logs);
    result.data = "the first two thirds of " + names_of(logs);
  } else {
    training.assign(logs.begin(), logs.end() - 1);
    held_out.push_back({&logs.back(), logs.back().time.front()});
    result.holdout = logs.back().source;
    result.data = names_of(training);
  }
  {
    StageProgress progress("identify");
    const auto tell = [&](const std::string& what, double fraction) { progress.set(what, fraction); };
    result.identification = identify(result.given, training, keys, tell);
    for (const char* name : kEstimators) {
      progress.set("estimators on the hold-out", 0);
      result.estimators.push_back(
          {name, errors_of(name, result.given, held_out), errors_of(name, result.identification.model, held_out)});
    }
  }
  write_identification(options.out, result);
  fmt::print("{}", notes);
  print(result);
  fmt::print("model: {}{}\n", (options.out / "model.xml").string(),
             adopted(result) ? "" : ", with the given numbers: the identified ones predict the hold-out worse");
  fmt::print("report: {}\n", (options.out / "report.html").string());
}

}  // namespace halyard
