#include "app/slurm/slurm_array.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "evaluation/json.h"
#include "evaluation/shell_words.h"
#include "model/input/text_file.h"
#include "model/input_error.h"
#include "model/output/output_files.h"
#include "model/output/unfinished.h"
#include "plugins/host/effect_module.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

fs::path job_file(const fs::path& out) { return out / "slurm" / "job.json"; }
fs::path script_file(const fs::path& out) { return out / "slurm" / "job.sh"; }

struct ShellResult {
  int exit_code = 0;
  std::string printed;  ///< on stdout and stderr
};

ShellResult run_in_shell(const std::string& command) {
  const auto close = [](FILE* pipe) { ::pclose(pipe); };
  std::unique_ptr<FILE, decltype(close)> pipe(::popen((command + " 2>&1").c_str(), "r"), close);
  if (!pipe) throw std::runtime_error("halyard sweep: no process can be started for: " + command);
  ShellResult result;
  char block[4096];
  while (const std::size_t n = std::fread(block, 1, sizeof block, pipe.get())) result.printed.append(block, n);
  const int status = ::pclose(pipe.release());
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  while (!result.printed.empty() && std::isspace(static_cast<unsigned char>(result.printed.back())))
    result.printed.pop_back();
  return result;
}

fs::path log_folder(const fs::path& out) { return fs::absolute(out) / "slurm"; }

/// The path with what sbatch replaces in names of files written out.
std::string log_pattern(const fs::path& out) {
  std::string pattern;
  for (const char c : log_folder(out).string()) pattern += c == '%' ? std::string("%%") : std::string(1, c);
  return pattern + "/part_%a.log";
}

/// "1-4,7,9-12": a list of each number would be too long for Slurm where there are thousands.
std::string in_ranges(const std::vector<std::size_t>& tasks) {
  std::vector<std::string> ranges;
  for (std::size_t first = 0, next; first < tasks.size(); first = next) {
    for (next = first + 1; next < tasks.size() && tasks[next] == tasks[next - 1] + 1;) ++next;
    const std::size_t from = tasks[first], to = tasks[next - 1];
    ranges.push_back(from == to ? fmt::format("{}", from) : fmt::format("{}-{}", from, to));
  }
  return fmt::format("{}", fmt::join(ranges, ","));
}

std::string cluster_option(const SlurmJob& job) {
  return job.cluster.empty() ? "" : " --clusters=" + in_shell_quotes(job.cluster);
}

bool is_job_number(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c); });
}

/// Of "17", or "17;cluster", among lines of warnings.
SlurmJob job_printed(const std::string& printed) {
  std::istringstream lines(printed);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t end = std::min(line.find(';'), line.size());
    const SlurmJob job{line.substr(0, end), end < line.size() ? line.substr(end + 1) : ""};
    if (is_job_number(job.number)) return job;
  }
  throw std::runtime_error("halyard sweep: sbatch printed no number of a job, but may have taken it; see squeue: " +
                           printed);
}

/// Hands the script to Slurm, and keeps the number of the job.
SlurmJob submit_and_note(const SlurmArray& array) {
  const ShellResult result = run_in_shell("sbatch --parsable " + in_shell_quotes(script_file(array.out).string()));
  if (result.exit_code != 0)
    throw std::runtime_error("halyard sweep: sbatch refused the job: " + result.printed +
                             (result.printed.find("array") == result.printed.npos
                                  ? ""
                                  : "; fewer --nodes may help: MaxArraySize in slurm.conf limits them"));
  const SlurmJob job = job_printed(result.printed);
  const nlohmann::ordered_json json = {{"sweep", array.id},
                                       {"job", job.number},
                                       {"cluster", job.cluster},
                                       {"parts", array.parts},
                                       {"options", array.options}};
  try {
    write_file_whole(job_file(array.out), json_text(json));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(
        fmt::format("{}; Slurm job {} was submitted, but --status will not know of it: end it with {}, make "
                    "room, and submit again",
                    error.what(), job.label(), cancel_command(job)));
  }
  return job;
}

}  // namespace

std::string slurm_script(const SlurmArray& array) {
  std::string text = fmt::format(
      "#!/bin/bash\n# Before sbatch: mkdir -p {}  (for what the tasks print; without it Slurm starts none)\n#SBATCH "
      "--job-name=halyard\n#SBATCH --array={}\n#SBATCH --nodes=1\n#SBATCH --exclusive\n"
      "#SBATCH --requeue\n#SBATCH --open-mode=append\n#SBATCH --output={}\n",
      in_shell_quotes(log_folder(array.out).string()), in_ranges(array.tasks), in_shell_quotes(log_pattern(array.out)));
  for (const std::string& option : array.options) text += "#SBATCH " + option + "\n";
  text += fmt::format("cd {} || exit 1\nexec {} sweep {} --out {} --shard \"$SLURM_ARRAY_TASK_ID/{}\" --resume \\\n",
                      in_shell_quotes(fs::current_path().string()),
                      in_shell_quotes(fs::read_symlink("/proc/self/exe").string()),
                      in_shell_quotes(array.sweep.string()), in_shell_quotes(array.out.string()), array.parts);
  return text + fmt::format(" {} --jobs \"${{SLURM_CPUS_ON_NODE:-1}}\"\n", effects_options(loaded_effect_modules()));
}

SlurmJob submit(const SlurmArray& array) {
  if (run_in_shell("command -v sbatch").exit_code != 0)
    throw InputError(
        "halyard sweep: --slurm: sbatch is not installed; run on a machine of the cluster, or take the script of "
        "--print-script there");
  write_file_whole(script_file(array.out), slurm_script(array));
  SlurmJob job;
  // A signal waits meanwhile: a job that nobody knows of would be submitted a second time.
  Unfinished().finish([&] { job = submit_and_note(array); });
  return job;
}

std::optional<SubmittedArray> submitted_array(const fs::path& out, const std::string& id) {
  if (!fs::exists(job_file(out))) return std::nullopt;
  const std::string text =
      read_text_file(job_file(out), {.name = "a job that sweep noted", .if_too_large = "remove it", .is_input = false});
  try {
    const auto json = nlohmann::ordered_json::parse(text);
    // Earlier programs wrote neither sweep nor cluster.
    if (json.value("sweep", id) != id) return std::nullopt;
    const SubmittedArray array{{json.at("job").get<std::string>(), json.value("cluster", std::string())},
                               whole_number(json.at("parts")),
                               json.value("options", std::vector<std::string>{})};
    if (is_job_number(array.job.number) && array.parts > 0) return array;
  } catch (const nlohmann::json::exception&) {}
  throw InputError(job_file(out).string() + ": is damaged; remove it");
}

std::string cancel_command(const SlurmJob& job) { return "scancel" + cluster_option(job) + " " + job.number; }

std::vector<ActiveTask> active_tasks(const SlurmJob& job) {
  const ShellResult result =
      run_in_shell("squeue --noheader --array" + cluster_option(job) + " --job=" + job.number + " --format='%K %T %N'");
  std::vector<ActiveTask> tasks;
  if (result.exit_code != 0) {
    if (result.printed.find("Invalid job id") != result.printed.npos) return tasks;
    throw std::runtime_error("halyard sweep: squeue cannot say whether Slurm job " + job.label() +
                             " still runs: " + result.printed);
  }
  std::istringstream lines(result.printed);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    ActiveTask task;
    std::string node;
    if (!(words >> task.task >> task.state)) continue;
    std::ranges::transform(task.state, task.state.begin(), [](unsigned char c) { return std::tolower(c); });
    if (words >> node) task.state += " on " + node;
    tasks.push_back(task);
  }
  return tasks;
}

}  // namespace halyard
