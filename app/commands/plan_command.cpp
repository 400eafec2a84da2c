#include "app/commands/plan_command.h"

#include <fmt/core.h>

#include <charconv>
#include <stdexcept>
#include <utility>

#include "app/output_check.h"
#include "app/pages/diagnosis/diagnosis_output.h"
#include "app/pages/plan_output.h"
#include "app/progress.h"
#include "app/terminal/terminal.h"
#include "model/input_error.h"
#include "model/model_file.h"

namespace halyard {
namespace {

/// "backlash@2", or "payload" of the whole arm.
PlacedEffect parse_effect(const std::string& text, const ArmModel& model) {
  const std::string where = "halyard diagnose: --separate " + in_quotes(text) + ": ";
  const std::size_t at = text.find('@');
  const Effect* effect = find_effect(text.substr(0, at));
  if (!effect) {
    std::string names;
    for (const Effect* e : effect_library()) names += (names.empty() ? "" : ", ") + e->name();
    throw InputError(where + "no such effect; expected one of " + names);
  }
  EffectPlace joint = kWholeArm;
  if (at != text.npos) {
    const char* end = text.data() + text.size();
    int number = 0;
    const auto [rest, error] = std::from_chars(text.data() + at + 1, end, number);
    if (error != std::errc() || rest != end || number < 1)
      throw InputError(where + "expected EFFECT@JOINT with a joint from 1 to " + std::to_string(model.n()) +
                       ", such as backlash@1");
    joint = number - 1;
  }
  for (const PlacedEffect& e : model.effects)
    if (e.effect == effect && e.joint == joint)
      throw InputError(where + "the model has this effect already; name one that it lacks");
  try {
    return place_effect(*effect, model.nominal, joint);
  } catch (const std::invalid_argument& error) {
    throw InputError(where + error.what());
  }
}

std::pair<PlacedEffect, PlacedEffect> parse_pair(const std::string& text, const ArmModel& model) {
  const std::size_t comma = text.find(',');
  if (comma == text.npos || text.find(',', comma + 1) != text.npos)
    throw InputError("halyard diagnose: --separate " + in_quotes(text) +
                     ": expected two effects, EFFECT@JOINT,EFFECT@JOINT, such as backlash@1,hysteresis@1");
  const auto pair = std::pair(parse_effect(text.substr(0, comma), model), parse_effect(text.substr(comma + 1), model));
  if (pair.first.effect == pair.second.effect && pair.first.joint == pair.second.joint)
    throw InputError("halyard diagnose: --separate " + in_quotes(text) + ": names one effect twice; name two");
  return pair;
}

/// What of the scenario's own robot the plan leaves out; empty if it is the model.
std::string left_out(const Scenario& scenario, const ArmModel& model) {
  if (model_to_xml(scenario.robot) == model_to_xml(model)) return "";
  std::string effects;
  for (const PlacedEffect& e : scenario.robot.effects) effects += (effects.empty() ? " (" : ", ") + effect_label(e);
  return "the robot of the scenario" + (effects.empty() ? "" : effects + ")") +
         " is not the model; the plan is of an arm as the model has it";
}

}  // namespace

void run_plan(const PlanCommandOptions& options) {
  const auto lock = options.out.empty() ? nullptr : lock_output_folder(options.out);
  Plan plan;
  plan.model = read_model(options.model);
  plan.model.source = options.model.string();
  plan.scenario = options.scenario.string();
  plan.joint_sensor = options.joint_sensor;
  Scenario scenario = read_scenario(options.scenario);
  if (!options.out.empty()) check_not_input(options.out / "scenario.xml");
  if (scenario.robot.n() != plan.model.n())
    throw InputError(fmt::format("{}: moves {} joints, {} has {}; give a scenario of this arm",
                                 options.scenario.string(), scenario.robot.n(), options.model.string(),
                                 plan.model.n()));
  if (!joints_alike(scenario.robot.nominal, plan.model.nominal))
    throw InputError(
        fmt::format("{}: its robot's joints are not of the types of those of {}, or are driven otherwise; give a "
                    "scenario of this arm",
                    options.scenario.string(), options.model.string()));
  if (constexpr double kShortest = 1.5; scenario.duration_s <= kShortest)
    throw InputError(fmt::format("{}: duration {:g} s: expected more than {:g} s, of which a plan can tell something",
                                 options.scenario.string(), scenario.duration_s, kShortest));
  std::optional<std::pair<PlacedEffect, PlacedEffect>> pair;
  if (!options.separate.empty()) pair = parse_pair(options.separate, plan.model);
  if (const std::string note = left_out(scenario, plan.model); !note.empty()) print_out("note: {}\n", note);
  scenario = planned_scenario(std::move(scenario), plan.model);
  scenario.model = options.model;
  {
    StageProgress progress("plan");
    const auto tell = [&](const std::string& what, double fraction) { progress.set(what, fraction); };
    plan.log = planned_log(scenario, options.joint_sensor, [&](double fraction) { tell("simulation", fraction); });
    plan.limits = detection_limits(plan.model, {plan.log}, tell);
    plan.names_nothing = names_nothing(plan.model, {plan.log});
    if (pair) {
      plan.separating = separating_motion(scenario, plan.log, pair->first, pair->second, options.joint_sensor, tell);
      if (plan.separating->scenario)
        plan.separating->scenario->name = effect_label(pair->first) + " from " + effect_label(pair->second);
    }
  }
  if (!options.out.empty()) {
    OutputFiles files;
    write_plan(files, options.out, plan);
    commit_outputs(files);
  }
  print_out("{}", plan_text(plan));
  if (options.out.empty()) return;
  if (plan.separating && plan.separating->scenario)
    print_out("scenario: {}\n", (options.out / "scenario.xml").string());
  print_out("report: {}\n", (options.out / "plan.html").string());
}

}  // namespace halyard
