#include "app/commands/identify_command.h"

#include <cmath>
#include <optional>
#include <utility>

#include "app/log_input.h"
#include "app/output_check.h"
#include "app/pages/identify_output.h"
#include "app/progress.h"
#include "app/terminal/terminal.h"
#include "diagnosis/log_check/log_check.h"
#include "evaluation/joint_unit.h"
#include "model/arm_log.h"
#include "model/input_error.h"
#include "model/model_file.h"

namespace halyard {
namespace {

void print(const IdentificationStudy& result) {
  for (const IdentifiedNumber& number : result.identification.numbers)
    print_out("{}: {:.5g} -> {:.7g}{} (95 %: {:.7g} to {:.7g}), {}\n", number.name, number.nominal, number.value,
              unit_suffix(number.unit), number.lower, number.upper, in_words(number.convergence));
  for (const std::string& doubt : doubts(result)) print_out("note: {}\n", doubt);
  const std::vector<JointUnit> units = joint_units(result.given);
  for (const EstimatorComparison& e : result.estimators)
    for (int k = 0; k < result.given.n(); ++k)
      if (!e.before.rms.empty() && !e.after.rms.empty() && std::isfinite(e.before.rms[k]))
        print_out("  joint {} {} position RMS on the hold-out: {:.4g} -> {:.4g} {}\n", k + 1, e.name,
                  units[k].shown_per_si * e.before.rms[k], units[k].shown_per_si * e.after.rms[k], units[k].shown);
}

}  // namespace

void run_identify(const IdentifyCommandOptions& options) {
  const auto lock = lock_output_folder(options.out);
  ArmModel model = read_model(options.model);
  model.columns = columns_of(model, options.columns);  // the model that is written reads the same logs
  const std::vector<std::string> keys = identified_keys(model, options.parameters);
  std::vector<std::filesystem::path> paths = options.data;
  if (!options.holdout.empty()) paths.push_back(options.holdout);
  check_given_once(paths);
  std::vector<Log> logs;
  std::string notes;
  for (const auto& path : paths) {
    logs.push_back(read_timed_log(model, path, {}));
    stop_at_gross_finding(check_log(logs.back(), model));
    if (const std::string note = ignored_columns_note(logs.back()); !note.empty()) notes += note + "\n";
  }
  std::optional<Log> holdout;
  if (!options.holdout.empty()) {
    holdout = std::move(logs.back());
    logs.pop_back();
  }
  check_not_input(options.out / "model.xml");
  IdentificationStudy result;
  {
    StageProgress progress("identify");
    result = study_identification(model, logs, holdout, keys,
                                  [&](const std::string& what, double fraction) { progress.set(what, fraction); });
  }
  OutputFiles files;
  write_identification(files, options.out, result);
  commit_outputs(files);
  print_out("{}", notes);
  print(result);
  print_out("model: {}{}\n", (options.out / "model.xml").string(),
            adopted(result) ? "" : ", with the given numbers: the identified ones predict the hold-out worse");
  print_out("report: {}\n", (options.out / "report.html").string());
}

}  // namespace halyard
