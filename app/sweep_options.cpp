#include "app/sweep_options.h"

#include <cstdint>
#include <memory>
#include <string>

#include "app/command_options.h"
#include "app/commands/sweep_command.h"

namespace halyard {
namespace {

/// The options of a sweep on a cluster; returns the one that asks for it.
CLI::Option* add_slurm_options(CLI::App& command, SweepSlurmOptions& slurm) {
  CLI::Option* wanted = command.add_flag_function(
      "--slurm", [](std::int64_t) {},
      "submit the parts that are not finished as a job array of Slurm; halyard merge DIR ends the sweep");
  add_number(command, "--nodes", slurm.nodes, {.least = 1, .most = 100000}, "with --slurm: parts, each on its own node")
      ->needs(wanted);
  command.add_option("--sbatch", slurm.sbatch_options, "with --slurm: an option for sbatch; may be repeated")
      ->type_name("--time=1:00:00")
      ->take_all()
      ->allow_extra_args(false)
      ->needs(wanted);
  command.add_flag("--print-script", slurm.print_script, "with --slurm: print the script, submit nothing")
      ->needs(wanted);
  return wanted;
}

}  // namespace

void add_sweep_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("sweep", "a parameter study: a grid, or samples");
  const auto options = std::make_shared<SweepCommandOptions>();
  const auto slurm = std::make_shared<SweepSlurmOptions>();
  const auto shard = std::make_shared<std::string>();
  const auto point = std::make_shared<std::size_t>();
  command.add_option("SWEEP.xml", options->sweep, "sweep file")->type_name("")->required();
  CLI::Option* out =
      command.add_option("--out", options->out, "folder of the results; required without --point")->type_name("DIR");
  CLI::Option* jobs =
      add_number(command, "--jobs", options->run.jobs, {.least = 1, .most = 1024}, "threads; default: one per core");
  CLI::Option* part = command.add_option("--shard", *shard, "compute part i of n, for halyard merge")->type_name("i/n");
  CLI::Option* resume = command.add_flag("--resume", options->run.resume, "keep what is finished, compute the rest");
  CLI::Option* slurm_wanted = add_slurm_options(command, *slurm);
  CLI::Option* status = command.add_flag_function(
      "--status", [](std::int64_t) {}, "say how far the sweep in DIR is, compute nothing");
  CLI::Option* single = add_number(command, "--point", *point, {}, "compute this point alone and print its errors");
  for (CLI::Option* computes : {jobs, part, resume})
    computes->excludes(slurm_wanted)->excludes(status)->excludes(single);
  slurm_wanted->excludes(status)->excludes(single);
  status->excludes(single);
  out->excludes(single);
  add_effects_option(command);
  finish(command, [=] {
    if (single->count() > 0) return run_sweep_point(*options, *point);
    if (out->count() == 0) throw CLI::RequiredError("--out");
    slurm->sweep = options->sweep, slurm->out = options->out;
    if (slurm_wanted->count() > 0) return run_sweep_slurm(*slurm);
    if (status->count() > 0) return run_sweep_status(options->sweep, options->out);
    if (part->count() > 0) options->run.shard = parse_shard(*shard);
    run_sweep_command(*options);
  });
}

void add_merge_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("merge", "put the parts of a sweep together");
  const auto options = std::make_shared<MergeCommandOptions>();
  command.add_option("DIR", options->parts, "folders of the parts of a sweep (--shard or --slurm)")
      ->type_name("")
      ->required();
  command.add_option("--out", options->out, "folder of the whole; default: the first part")->type_name("DIR");
  finish(command, [options] {
    if (options->out.empty()) options->out = options->parts.front();
    run_merge_command(*options);
  });
}

}  // namespace halyard
