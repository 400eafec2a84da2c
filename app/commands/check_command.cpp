#include "app/commands/check_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "app/bundled_files.h"
#include "app/terminal/terminal.h"
#include "diagnosis/log_check/log_check.h"
#include "estimators/process/process_model.h"
#include "evaluation/run/contained_run.h"
#include "evaluation/run/tried_effects.h"
#include "evaluation/sweep/sweep_run.h"
#include "model/arm_log.h"
#include "model/input_error.h"
#include "model/model_file.h"
#include "model/xml/xml_reader.h"
#include "plant/scenario.h"
#include "transmission/effect.h"

namespace halyard {
namespace {

/// Also tells the values that the file leaves out.
std::string effect_list(const ArmModel& model) {
  std::vector<std::string> effects;
  for (const PlacedEffect& placed : model.effects) {
    std::vector<std::string> values;
    const double* value = placed.p;
    for (const EffectParameter& p : placed.effect->parameters(model.nominal, placed.joint))
      values.push_back(fmt::format("{} {:.4g}{}", p.name, *value++, p.unit == "1" ? "" : " " + p.unit));
    effects.push_back(fmt::format("{} ({})", effect_label(placed), fmt::join(values, ", ")));
  }
  return effects.empty() ? "none" : fmt::format("{}", fmt::join(effects, ", "));
}

/// Ranges that are so wide that they may be in degrees.
void print_range_notes(const ArmModel& model) {
  constexpr double kManyTurns = 4;
  for (int k = 0; k < model.n(); ++k) {
    const JointDescription& joint = model.joints[k];
    const double turns = (joint.upper - joint.lower) / (2 * std::numbers::pi);
    if (model.nominal.joint[k].type == JointType::revolute && turns > kManyTurns)
      print_out("note: the range of joint {} is {:.3g} turns wide; if it is in degrees, write deg behind its numbers\n",
                k + 1, turns);
  }
}

/// Radii and a gravity that are so large that they may be in millimetres.
void print_size_notes(const ArmModel& model) {
  constexpr double kLargeRadius_m = 1, kLargeGravity = 30;
  for (int k = 0; k < model.n(); ++k) {
    const JointParameters<double>& j = model.nominal.joint[k];
    const bool turns = j.type == JointType::revolute;
    for (const auto& [what, radius] : {std::pair("capstan", j.capstan_radius), std::pair("pulley", j.pulley_radius)})
      if (j.drive == Drive::cable && radius > kLargeRadius_m && (turns || what == std::string("capstan")))
        print_out("note: the {} of joint {} has a radius of {:g} m; if it is in millimetres, write mm behind it\n",
                  what, k + 1, radius);
  }
  const double g = std::hypot(model.nominal.gravity[0], model.nominal.gravity[1], model.nominal.gravity[2]);
  if (g > kLargeGravity) print_out("note: gravity is {:g} m/s^2; on earth it is 9.81\n", g);
}

/// An arm whose states settle faster than the filters can follow at the usual rate of a log. The plant can simulate it.
void print_note_of_filters(const ArmModel& model) {
  constexpr double kUsualStep_s = 1e-3;
  try {
    ProcessModel(model).substeps(kUsualStep_s);
  } catch (const std::runtime_error& error) {
    print_out("note: the Kalman filters will refuse this arm: {}\n", error.what());
  }
}

/// unchecked: estimators whose options could not be checked.
void print_arm(const ArmModel& model, const std::vector<std::string>& unchecked) {
  print_out("  {} joint{}:", model.n(), model.n() == 1 ? "" : "s");
  for (int k = 0; k < model.n(); ++k) {
    const JointParameters<double>& joint = model.nominal.joint[k];
    const char* drive = joint.drive == Drive::cable ? "cable" : joint.drive == Drive::rigid ? "rigid" : "no drive";
    print_out("{} {} ({}, {})", k == 0 ? "" : ",", model.joints[k].name,
              joint.type == JointType::revolute ? "revolute" : "prismatic", drive);
  }
  print_out("\n  effects: {}\n", effect_list(model));
  print_range_notes(model);
  print_size_notes(model);
  print_note_of_filters(model);
  if (!unchecked.empty())
    print_out("  not checked: options of estimators that are not installed: {}\n", fmt::join(unchecked, ", "));
}

/// Makes each estimator that the model has options for. Returns the names of those that are not installed.
std::vector<std::string> check_estimator_options(const ArmModel& model) {
  std::vector<std::string> unchecked;
  if (model.estimators.empty()) return unchecked;
  const std::vector<PluginInfo> installed = contained_plugins();
  for (const auto& [name, options] : model.estimators) {
    if (std::ranges::find(installed, name, &PluginInfo::name) != installed.end()) check_estimator(name, model);
    else unchecked.push_back(name);
  }
  return unchecked;
}

void check_model(const std::filesystem::path& file) {
  const ArmModel model = read_model(file);
  const std::vector<std::string> unchecked = check_estimator_options(model);
  print_out("{}: valid model \"{}\"\n", file.string(), model.name);
  print_arm(model, unchecked);
}

void check_scenario(const std::filesystem::path& file) {
  const Scenario scenario = read_scenario(file);
  const std::vector<std::string> unchecked = check_estimator_options(scenario.robot);
  print_out("{}: valid scenario \"{}\", {:g} s, of the model {}\n", file.string(), scenario.name, scenario.duration_s,
            scenario.model.string());
  print_arm(scenario.robot, unchecked);
}

void check_sweep(const std::filesystem::path& file) {
  const Sweep sweep = read_sweep(file);
  check_estimators(sweep);
  print_out("{}: valid sweep \"{}\", {} points, {} {}\n", file.string(), sweep.grid.name, sweep.grid.size(),
            sweep.grid.measures_limits() ? "limits of" : "estimators", fmt::join(sweep.grid.subjects(), ", "));
  for (const SweepAxis& axis : sweep.grid.axes) {
    const auto [least, greatest] = std::ranges::minmax(axis.values);
    print_out("  {}: {} values from {:g} to {:g}\n", axis.label(), axis.values.size(), least, greatest);
  }
}

ContainmentOptions containment_of(const CheckOptions& options) {
  ContainmentOptions containment;
  containment.step_limit_s = options.time_limit_s.value_or(containment.step_limit_s);
  return containment;
}

void check_estimator_module(const CheckOptions& options) {
  const std::string module = options.file.string();
  const ArmModel model =
      read_model(options.model.empty() ? examples_folder({}, "check") / "raven2" / "raven2.xml" : options.model);
  const std::vector<std::string> faults = contained_faults(module, model, options.kalman, containment_of(options));
  if (!faults.empty())
    throw InputError(fmt::format("{}: breaks {} of the promises of an estimator (plugins/host/conformance.h): {}",
                                 module, faults.size(), fmt::join(faults, "; ")));
  print_out("{}: keeps what every estimator promises{}, tried with {}\n", module,
            options.kalman ? ", and is the Kalman filter on a linear arm" : "", model.source);
}

/// Whether the module is one of effects. Its exported name stands in the file as text: nothing of the module is run.
bool is_effect_module(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) return false;
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const auto exports = [&](const std::string& name) { return text.find('\0' + name + '\0') != text.npos; };
  return exports("halyard_effects") && !exports("halyard_estimator");
}

void check_effect_module(const CheckOptions& options) {
  if (!options.model.empty() || options.kalman)
    throw InputError("halyard check: --model and --kalman are for an estimator's module, and " +
                     in_quotes(options.file.string()) + " has effects; leave them out");
  const std::size_t before = effect_library().size();
  load_tried_effects(options.file, containment_of(options));
  std::vector<std::string> effects;
  for (std::size_t i = before; i < effect_library().size(); ++i)
    effects.push_back(fmt::format("{}, {}", effect_library()[i]->name(), effect_library()[i]->summary()));
  print_out("{}: valid module of {} effect{}: {}\n", options.file.string(), effects.size(),
            effects.size() == 1 ? "" : "s", fmt::join(effects, "; "));
}

/// "nothing suspicious", "2 suspicious, 1 corrected by a diagnosis".
std::string summary_of(const std::vector<LogFinding>& findings) {
  const auto corrected = std::ranges::count(findings, LogFinding::Severity::corrected, &LogFinding::severity);
  const auto suspicious = static_cast<std::ptrdiff_t>(findings.size()) - corrected;
  return (suspicious == 0 ? "nothing suspicious" : fmt::format("{} suspicious", suspicious)) +
         (corrected == 0 ? "" : fmt::format(", {} corrected by a diagnosis", corrected));
}

/// Prints what was found; the first gross finding is the error.
void check_log_file(const CheckOptions& options) {
  if (options.model.empty())
    throw InputError("halyard check: the log " + in_quotes(options.file.string()) +
                     " is checked against the model of its arm; give it with --model M.xml");
  const ArmModel model = read_model(options.model);
  const Log log = read_log_of(model, options.file, options.columns, /*torque_required=*/false);
  for (const std::string& note : {ignored_columns_note(log), missing_torques_note(log, model)})
    if (!note.empty()) print_out("{}\n", note);
  const std::vector<LogFinding> findings = check_log(log, model, columns_of(model, options.columns));
  for (const LogFinding& f : findings) print_out("{}: {}\n", severity_word(f.severity), finding_line(f));
  stop_at_gross_finding(findings, ", listed on stdout");
  print_out("{}: {} samples over {:.4g} s of \"{}\", {}\n", options.file.string(), log.size(), log.duration(),
            model.name, summary_of(findings));
}

}  // namespace

void run_check(const CheckOptions& options) {
  const std::filesystem::path& file = options.file;
  const bool is_module = file.extension() == ".so";
  if (is_module && !options.columns.empty())
    throw InputError("halyard check: --column is for a log (.csv), and " + in_quotes(file.string()) +
                     " is a module; leave it out");
  if (!is_module && options.time_limit_s)
    throw InputError("halyard check: --time-limit is for a module (.so), and " + in_quotes(file.string()) +
                     " is none; leave it out");
  if (is_module) return is_effect_module(file) ? check_effect_module(options) : check_estimator_module(options);
  if (options.kalman)
    throw InputError("halyard check: --kalman is for an estimator's module (.so), and " + in_quotes(file.string()) +
                     " is none; leave it out");
  if (file.extension() == ".csv" || (file.extension() != ".xml" && !options.model.empty()))
    return check_log_file(options);
  if (!options.model.empty() || !options.columns.empty())
    throw InputError(
        "halyard check: --model is for a log (.csv) and an estimator's module (.so), --column for a log, and " +
        in_quotes(file.string()) + " is none of these; leave them out");
  const XmlElement root = XmlElement::read_file(file);
  if (root.tag() == "arm") return check_model(file);
  if (root.tag() == "scenario") return check_scenario(file);
  if (root.tag() == "sweep") return check_sweep(file);
  root.fail("expected the root element <arm> of a model, <scenario> or <sweep>; give one of these files");
}

}  // namespace halyard
