#include "app/command_line.h"

#include <memory>
#include <string>
#include <vector>

#include "app/command_options.h"
#include "app/commands/check_command.h"
#include "app/commands/compare_command.h"
#include "app/commands/diagnose_command.h"
#include "app/commands/estimate_command.h"
#include "app/commands/identify_command.h"
#include "app/commands/plan_command.h"
#include "app/commands/plugins_command.h"
#include "app/commands/simulate_command.h"
#include "app/sweep_options.h"
#include "app/tour/experiments_command.h"
#include "app/tour/tour_command.h"
#include "evaluation/estimator_list.h"
#include "halyard/version.h"
#include "model/input_error.h"

namespace halyard {
namespace {

CLI::Option* add_columns_option(CLI::App& command, std::vector<std::string>& columns) {
  return command
      .add_option("--column", columns,
                  "which column of the log is which signal; overrides the model's map; may be repeated")
      ->type_name("NAME=COLUMN[,unit=U][,sign=-1][,scale=S][,offset=O][,wrap=P]")
      ->take_all()
      ->allow_extra_args(false);
}

void add_skip_option(CLI::App& command, double& skip_s) {
  add_number(command, "--skip", skip_s, {}, "start of the record that the errors leave out, in s")
      ->type_name("S")
      ->capture_default_str();
}

void add_joint_torque_flag(CLI::App& command, bool& flag) {
  command.add_flag("--use-joint-torque", flag, "also give the estimators the measured external loads of the log");
}

void add_robot_option(CLI::App& command, std::filesystem::path& robot) {
  command
      .add_option("--robot", robot,
                  "for a scenario: model file of the true robot, with its effects; default: the scenario's model")
      ->type_name("ROBOT.xml");
}

void add_simulate_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("simulate", "simulate a scenario, write a log and its ground truth");
  const auto options = std::make_shared<SimulateOptions>();
  command.add_option("SCENARIO.xml", options->scenario, "scenario file")->type_name("")->required();
  add_robot_option(command, options->robot);
  command.add_option("--out", options->out, "log; the truth goes to LOG.truth.csv")->type_name("LOG.csv")->required();
  add_effects_option(command);
  finish(command, [options] { run_simulate(*options); });
}

void add_estimate_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("estimate", "run one estimator over a log, without its joint sensors");
  const auto options = std::make_shared<EstimateCommandOptions>();
  command.add_option("--model", options->model, "model file")->type_name("M.xml")->required();
  command.add_option("--estimator", options->estimator, "name or path of a plug-in")
      ->type_name("NAME_OR_PLUGIN.so")
      ->required();
  command.add_option("--data", options->data, "log")->type_name("LOG.csv")->required();
  command.add_option("--out", options->out, "estimates")->type_name("EST.csv")->required();
  add_columns_option(command, options->columns);
  add_joint_torque_flag(command, options->use_joint_torque);
  add_skip_option(command, options->skip_s);
  add_effects_option(command);
  finish(command, [options] { run_estimate(*options); });
}

void add_compare_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("compare", "run several estimators on the same data and compare their errors");
  const auto options = std::make_shared<CompareCommandOptions>();
  const auto estimators = std::make_shared<std::string>();
  command.add_option("SCENARIO_OR_LOG", options->data, "scenario (.xml), which is simulated, or log")
      ->type_name("")
      ->required();
  command.add_option("--model", options->model, "model file; default: the scenario's own")->type_name("M.xml");
  add_robot_option(command, options->robot);
  command.add_option("--estimators", *estimators, "names or paths of plug-ins")->type_name("a,b,./c.so")->required();
  command.add_option("--out", options->out, "folder of the report")->type_name("DIR")->required();
  add_columns_option(command, options->columns);
  add_joint_torque_flag(command, options->use_joint_torque);
  add_skip_option(command, options->skip_s);
  add_number(command, "--step-limit", options->step_limit_s, {.above_least = true},
             "an estimator that takes longer for a step is stopped, in s")
      ->type_name("S")
      ->capture_default_str();
  add_number(command, "--runs", options->runs, {.least = 1, .most = 100000},
             "for a scenario: simulate so many seeds and compare over all of them")
      ->capture_default_str();
  add_number(
      command, "--noise", options->noise, {},
      "of a scenario: disturb the arm by so many times the process and measurement noise that the filters assume");
  add_effects_option(command);
  finish(command, [options, estimators] {
    options->estimators = split_estimators(*estimators);
    run_compare(*options);
  });
}

/// --plan and the options that belong to it. without: options that mean nothing to a plan.
CLI::Option* add_plan_options(CLI::App& command, const std::shared_ptr<PlanCommandOptions>& plan,
                              std::vector<std::filesystem::path>& files, const std::vector<CLI::Option*>& without) {
  CLI::Option* planned = command
                             .add_option("--plan", files,
                                         "before there are data: which effects a diagnosis of this model in the "
                                         "scenario's motion would see, from what size on")
                             ->type_name("MODEL.xml SCENARIO.xml")
                             ->expected(2);
  for (CLI::Option* option : without) planned->excludes(option);
  command.add_option("--separate", plan->separate, "with --plan: propose a motion that tells these two apart")
      ->type_name("EFFECT@JOINT,EFFECT@JOINT")
      ->needs(planned);
  command
      .add_flag_callback(
          "--no-joint-sensor", [plan] { plan->joint_sensor = false; },
          "with --plan: the joints will have no sensor, only the motors")
      ->needs(planned);
  return planned;
}

void add_diagnose_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("diagnose", "find the effects that a model lacks, from logs, and add them to it");
  const auto options = std::make_shared<DiagnoseCommandOptions>();
  const auto plan = std::make_shared<PlanCommandOptions>();
  const auto plan_files = std::make_shared<std::vector<std::filesystem::path>>();
  CLI::Option* model =
      command.add_option("--model", options->model, "model file; required without --plan")->type_name("M.xml");
  CLI::Option* data =
      command.add_option("--data", options->data, "log to learn from; required without --plan; may be repeated")
          ->type_name("LOG.csv")
          ->take_all()
          ->allow_extra_args(false);
  CLI::Option* holdout = command
                             .add_option("--holdout", options->holdout,
                                         "log on which the errors are computed; default: the last third of each log")
                             ->type_name("LOG.csv");
  CLI::Option* out =
      command.add_option("--out", options->out, "folder of model.xml, diagnosis.json and report.html, or of the plan")
          ->type_name("DIR");
  CLI::Option* columns = add_columns_option(command, options->columns);
  add_effects_option(command);
  CLI::Option* progress =
      command.add_flag("--progress", options->progress_in_pipe,
                       "tell the progress even if stderr is not a terminal: a line every ten seconds");
  CLI::Option* rehearsals =
      add_number(command, "--rehearse", options->rehearsals, {.least = 1, .most = 10000},
                 "then diagnose so many logs of the same motion and noise, with known effects, and count how often the "
                 "names are right; each takes about as long as the diagnosis");
  add_number(command, "--seed", options->seed, {.most = 1e15}, "of the rehearsals")
      ->capture_default_str()
      ->needs(rehearsals);
  CLI::Option* planned =
      add_plan_options(command, plan, *plan_files, {model, data, holdout, columns, progress, rehearsals});
  finish(command, [=] {
    if (planned->count() > 0) {
      plan->model = plan_files->at(0);
      plan->scenario = plan_files->at(1);
      plan->out = options->out;
      return run_plan(*plan);
    }
    for (const CLI::Option* required : {model, data, out})
      if (required->count() == 0) throw CLI::RequiredError(required->get_name());
    run_diagnose(*options);
  });
}

void add_identify_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("identify", "find numbers of the model from logs with joint sensors, by a dual filter");
  const auto options = std::make_shared<IdentifyCommandOptions>();
  command.add_option("--model", options->model, "model file")->type_name("M.xml")->required();
  command.add_option("--data", options->data, "log with joint sensors; may be repeated")
      ->type_name("LOG.csv")
      ->required()
      ->take_all()
      ->allow_extra_args(false);
  command
      .add_option("--holdout", options->holdout,
                  "log on which the errors are computed; default: the last third of each log")
      ->type_name("LOG.csv");
  command
      .add_option("--parameters", options->parameters,
                  "coupling, stiffness, damping, tension, motor_friction, joint_friction, or keys of single numbers as "
                  "sweeps name them")
      ->type_name("a,b,joint2.cable.stiffness")
      ->required();
  command.add_option("--out", options->out, "folder of model.xml, identify.json, convergence.csv and report.html")
      ->type_name("DIR")
      ->required();
  add_columns_option(command, options->columns);
  add_effects_option(command);
  finish(command, [options] { run_identify(*options); });
}

void add_experiments_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("experiments", "the paper's experiments A, B and C on the simulated RAVEN-II");
  const auto options = std::make_shared<ExperimentsOptions>();
  command.add_option("--out", options->out, "folder of the report")->type_name("DIR")->required();
  command.add_option("--examples", options->examples, "folder of the examples; default: those of this program")
      ->type_name("DIR");
  command
      .add_option("--calibrated", options->calibrated,
                  "calibrated model that kinematics and sr_ukf are run with too; default: raven2.xml with couplings "
                  "identified here")
      ->type_name("M.xml");
  add_number(command, "--duration", options->duration_s, {.above_least = true},
             "of each experiment, in s; default: the scenarios'")
      ->type_name("S");
  command.add_flag_callback(
      "--no-effect-study", [options] { options->effect_study = false; },
      "leave out the study of single effects, which takes most of the time");
  finish(command, [options] { run_experiments(*options); });
}

void add_plugins_command(CLI::App& app) {
  finish(*app.add_subcommand("plugins", "list the estimators, built-in and found"), run_plugins);
}

void add_check_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("check", "validate a model, scenario, sweep or estimator; or check a log");
  const auto options = std::make_shared<CheckOptions>();
  command
      .add_option("FILE", options->file,
                  "model, scenario or sweep; the module of an estimator, MODULE.so; or a log, LOG.csv")
      ->type_name("")
      ->required();
  command
      .add_option("--model", options->model,
                  "of a log: its arm, required; of an estimator: the arm to try it with; default: the RAVEN-II")
      ->type_name("M.xml");
  add_columns_option(command, options->columns);
  command.add_flag("--kalman", options->kalman,
                   "of an estimator: it is a Kalman filter with halyard's noise; hold it "
                   "against the textbook's on a linear arm");
  add_number(
      command, "--time-limit", options->time_limit_s, {.above_least = true},
      "of a module: limit for loading its effects, or for testing one promise of its estimator, in s; default: 10")
      ->type_name("S");
  add_effects_option(command);
  finish(command, [options] { run_check(*options); });
}

void add_tour_command(CLI::App& app) {
  CLI::App& command =
      *app.add_subcommand("tour", "the main job: experiments, a diagnosis, and recordings of real rigs, in one report");
  const auto options = std::make_shared<TourOptions>();
  command.add_option("--out", options->out, "folder of the report")->type_name("DIR")->required();
  command.add_option("--examples", options->examples, "folder of the examples; default: those of this program")
      ->type_name("DIR");
  command
      .add_option("--recordings", options->recordings,
                  "folder with a folder for each rig; default: shared/data beside the project, where it exists")
      ->type_name("DIR");
  finish(command, [options] { run_tour(*options); });
}

std::string command_names(const CLI::App& app) {
  std::string names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.append(names.empty() ? "" : ", ").append(command->get_name());
  }
  return names;
}

/// CLI11 takes a wrong command for a superfluous argument of a missing one.
void check_command_name(const CLI::App& app, int argc, char** argv) {
  const std::string name = argc < 2 ? "-" : argv[1];
  if (name.starts_with("-")) return;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == name) return;
  }
  throw InputError("halyard: no command " + in_quotes(name) + "; expected one of " + command_names(app) +
                   "; see halyard --help");
}

/// "; did you mean --column?" if an option of the command begins so, or the word begins as an option; else empty.
std::string similar_option(const CLI::App& command, std::string word) {
  word = word.substr(0, word.find('='));
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames())
      if (const std::string full = "--" + name; word.size() > 4 && (full.starts_with(word) || word.starts_with(full)))
        return "; did you mean " + full + "?";
  return "";
}

/// A required option is often missing because the user has given another: that one is named first. first: argument of
/// the program.
[[noreturn]] void fail_usage(const CLI::App& app, const CLI::ParseError& error, const std::string& first) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  const std::string command = parsed.empty() ? "halyard" : "halyard " + parsed.front()->get_name();
  const std::vector<std::string> strays = app.remaining(/*recurse=*/true);
  std::string fault = error.what();
  if (!parsed.empty() && !strays.empty()) {
    fault = strays.front() == first
                ? first + " stands before the command; give it behind " + command
                : strays.front() + " was not expected" + similar_option(*parsed.front(), strays.front());
  }
  throw InputError(command + ": " + fault + "; see " + command + " --help" +
                   (parsed.empty() ? "" : " or halyard --help"));
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CLI::App app("Joint positions of cable-driven arms from motor signals: simulate, estimate, compare, diagnose.",
               "halyard");
  app.set_version_flag("--version", std::string("halyard ") + kVersion);
  add_simulate_command(app);
  add_estimate_command(app);
  add_compare_command(app);
  add_diagnose_command(app);
  add_identify_command(app);
  add_experiments_command(app);
  add_sweep_command(app);
  add_merge_command(app);
  add_plugins_command(app);
  add_check_command(app);
  add_tour_command(app);
  check_command_name(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    fail_usage(app, error, argc < 2 ? "" : argv[1]);
  }
  if (app.get_subcommands().empty()) {
    throw InputError("halyard: a command is missing; expected one of " + command_names(app) + "; see halyard --help");
  }
  return 0;
}

}  // namespace halyard
