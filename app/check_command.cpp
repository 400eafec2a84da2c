#include "app/check_command.h"

#include <fmt/format.h>

#include "app/sweep_file.h"
#include "model/input_error.h"
#include "model/model_file.h"
#include "model/xml_reader.h"
#include "plant/scenario.h"

namespace halyard {
namespace {

std::string effect_list(const ArmModel& model) {
  std::vector<std::string> names;
  for (const PlacedEffect& placed : model.effects) {
    std::string name = placed.effect->name();
    if (placed.joint >= 0) name += fmt::format(" (joint {})", placed.joint + 1);
    names.push_back(name);
  }
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

void print_arm(const ArmModel& model) {
  fmt::print("  {} joints:", model.n());
  for (int k = 0; k < model.n(); ++k) {
    const JointParameters<double>& joint = model.nominal.joint[k];
    const char* drive = joint.drive == Drive::cable ? "cable" : joint.drive == Drive::rigid ? "rigid" : "no drive";
    fmt::print("{} {} ({}, {})", k == 0 ? "" : ",", model.joints[k].name,
               joint.type == JointType::revolute ? "revolute" : "prismatic", drive);
  }
  fmt::print("\n  effects: {}\n", effect_list(model));
}

void check_model(const std::filesystem::path& file) {
  const ArmModel model = read_model(file);
  fmt::print("{}: valid model \"{}\"\n", file.string(), model.name);
  print_arm(model);
}

void check_scenario(const std::filesystem::path& file) {
  const Scenario scenario = read_scenario(file);
  fmt::print("{}: valid scenario \"{}\", {:g} s, of the model {}\n", file.string(), scenario.name, scenario.duration_s,
             scenario.model.string());
  print_arm(scenario.robot);
}

void check_sweep(const std::filesystem::path& file) {
  const Sweep sweep = read_sweep(file);
  fmt::print("{}: valid sweep \"{}\", {} points, estimators {}\n", file.string(), sweep.grid.name, sweep.grid.size(),
             fmt::join(sweep.grid.estimators, ", "));
  for (const SweepAxis& axis : sweep.grid.axes) {
    fmt::print("  {}: {} values from {:g} to {:g}\n", axis.label(), axis.values.size(), axis.values.front(),
               axis.values.back());
  }
}

}  // namespace

void run_check(const std::filesystem::path& file) {
  const XmlElement root = XmlElement::read_file(file);
  if (root.tag() == "arm") return check_model(file);
  if (root.tag() == "scenario") return check_scenario(file);
  if (root.tag() == "sweep") return check_sweep(file);
  root.fail("expected the root element <arm> of a model, <scenario> or <sweep>; give one of these files");
}

}  // namespace halyard
