#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "model/input_error.h"
#include "model/log.h"
#include "model/model_file.h"
#include "model/name_list.h"
#include "model/xml/xml_reader.h"
#include "plant/xml/scenario_words.h"

namespace halyard {
namespace {

/// <set parameter="joint1.cable.tension" value="27.5"/>
void read_change(const XmlElement& set, ArmModel& robot, std::set<std::string>& changed) {
  set.only({"parameter", "value"});
  const std::string key = set.text("parameter");
  if (!changed.insert(key).second) set.fail("parameter", "is set twice; remove one of the two");
  const std::vector<ParameterInfo> all = named_parameters(robot.nominal);
  const auto found = std::ranges::find(all, key, &ParameterInfo::key);
  if (found == all.end()) {
    const std::string joint = key.substr(0, key.find('.') + 1);  // of a right joint, its numbers will do
    const auto is_of_joint = [&](const ParameterInfo& p) { return !joint.empty() && p.key.starts_with(joint); };
    const bool right = std::ranges::any_of(all, is_of_joint);
    std::vector<std::string> known;
    for (const ParameterInfo& p : all)
      if (!right || is_of_joint(p)) known.push_back(p.key);
    set.fail("parameter", "the model has no such number; expected one of " + listed(known));
  }
  found->number.set(set.number("value", found->unit == "1" ? "" : found->unit));
}

/// Changes that a model file may not say, a scenario may not either. Only all of them together have to be right.
void read_changes(const std::vector<XmlElement>& sets, ArmModel& robot) {
  std::set<std::string> changed;
  for (const XmlElement& set : sets) read_change(set, robot, changed);
  if (sets.empty()) return;
  try {
    parse_model(model_to_xml(robot), "the model so changed");
  } catch (const InputError& error) {
    sets.back().fail("value", error.what());
  }
}

void read_sines(const XmlElement& element, const std::string& unit, JointTrajectory& t) {
  element.only({"joint", "kind", "center"}, {"sine"});
  t.center = element.number("center", unit);
  for (const XmlElement& sine : element.children()) {
    sine.only({"amplitude", "frequency", "phase"});
    t.sines.push_back({sine.number("amplitude", unit), sine.number("frequency", "Hz", Sign::positive),
                       sine.number_or("phase", 0, "rad")});
  }
  if (t.sines.empty()) element.fail("expected at least one <sine amplitude=\"\" frequency=\"\"/>");
}

void check_column(const XmlElement& element, const std::filesystem::path& file, const std::string& column) {
  const std::vector<std::string> names = column_names(file);
  if (names.empty() || std::ranges::find(names, column) != names.end()) return;  // read_log says what else is wrong
  std::vector<std::string> known;
  for (const std::string& name : names) known.push_back(in_quotes(name));
  element.fail("column", file.string() + " has no column " + in_quotes(column) + "; it has " + listed(known) +
                             "; give one of these as column");
}

/// Read as a log of one joint, so that numbers, gaps and times are checked as everywhere.
void read_samples(const XmlElement& element, int joint, JointTrajectory& t) {
  element.only({"joint", "kind", "file", "column"});
  t.file = element.path("file");
  t.column = element.text_or("column", "joint_position_" + std::to_string(joint + 1));
  check_column(element, t.file, t.column);
  ColumnMap columns;
  columns.add("motor_position_1", t.column);
  const Log log = read_log(t.file, 1, columns, ReadOptions{.torque_required = false});
  for (std::size_t i = 0; i < log.size(); ++i) {
    if (std::isnan(log.motor_position[0][i])) continue;
    t.sample_time.push_back(log.time[i] - log.time[0]);
    t.sample_position.push_back(log.motor_position[0][i]);
  }
}

void read_trajectory(const XmlElement& element, Scenario& scenario, std::vector<bool>& given) {
  using Kind = JointTrajectory::Kind;
  const int joint = static_cast<int>(element.integer("joint", 1, scenario.robot.n())) - 1;
  if (given[joint]) element.fail("joint", "another <trajectory> is of this joint; remove one of them");
  given[joint] = true;
  const std::string unit = scenario.robot.nominal.joint[joint].type == JointType::revolute ? "rad" : "m";
  JointTrajectory t;
  t.kind = element.choice("kind", words_of(t.kind));
  switch (t.kind) {
    case Kind::hold:
      element.only({"joint", "kind", "center"});
      t.center = element.number("center", unit);
      break;
    case Kind::sines: read_sines(element, unit, t); break;
    case Kind::point_to_point:
      element.only({"joint", "kind", "points", "move", "dwell"});
      t.points = element.numbers("points", unit);
      t.move_s = element.number_or("move", t.move_s, "s", Sign::positive);
      t.dwell_s = element.number_or("dwell", t.dwell_s, "s", Sign::non_negative);
      break;
    case Kind::samples: read_samples(element, joint, t); break;
  }
  scenario.trajectory[joint] = std::move(t);
}

/// The true robot where it is not the one of the model.
ArmModel read_robot(const std::filesystem::path& path, const ArmParameters<double>& assumed,
                    const std::filesystem::path& model) {
  ArmModel robot = read_model(path);
  if (!joints_alike(robot.nominal, assumed))
    throw InputError(path.string() + ": its joints are not those of the scenario's model " + model.string() +
                     "; give a robot with as many joints, of the same types and driven alike");
  return robot;
}

void read_integrator(const XmlElement& element, IntegratorOptions& options) {
  element.only({"treatment", "relative_tolerance", "absolute_tolerance"});
  options.kind = element.choice_or("treatment", options.kind, words_of(options.kind));
  if (is_of_simbody(options.kind) && element.has("absolute_tolerance"))
    element.fail("absolute_tolerance", "an integrator of Simbody's has only a relative tolerance; remove it");
  options.relative_tolerance = element.number_or("relative_tolerance", options.relative_tolerance, "", Sign::positive);
  options.absolute_tolerance = element.number_or("absolute_tolerance", options.absolute_tolerance, "", Sign::positive);
}

/// Standard deviations [n] from one number for all joints or from one for each; none if the attribute is absent or all
/// are zero.
std::vector<double> read_noise(const XmlElement& sensors, const std::string& name, const std::string& unit, int n) {
  if (!sensors.has(name)) return {};
  std::vector<double> noise = sensors.numbers(name, unit);
  if (noise.size() == 1) noise.assign(static_cast<std::size_t>(n), noise[0]);
  if (static_cast<int>(noise.size()) != n || std::ranges::any_of(noise, [](double s) { return s < 0; }))
    sensors.fail(name, "expected one number, or one for each of the " + std::to_string(n) +
                           " joints with blanks between, none of them negative");
  if (std::ranges::all_of(noise, [](double s) { return s == 0; })) return {};
  return noise;
}

void read_sensors(const XmlElement& sensors, Scenario& scenario) {
  sensors.only({"quantise", "homed", "torque_noise", "motor_position_noise", "joint_position_noise"});
  scenario.quantise = sensors.flag_or("quantise", scenario.quantise);
  scenario.homed = sensors.flag_or("homed", scenario.homed);
  const int n = scenario.robot.n();
  scenario.noise.motor_torque = read_noise(sensors, "torque_noise", "N m", n);
  scenario.noise.motor_reading = read_noise(sensors, "motor_position_noise", "rad", n);
  scenario.noise.joint_reading = read_noise(sensors, "joint_position_noise", "", n);  // rad or m, joint by joint
}

}  // namespace

Scenario read_scenario(const std::filesystem::path& path, const std::filesystem::path& robot) {
  const XmlElement root = XmlElement::read_file(path, "scenario");
  root.only({"name", "model", "duration", "seed", "engine"},
            {"set", "effects", "trajectory", "control", "integrator", "sensors", "camera"});
  Scenario scenario;
  scenario.name = root.text("name");
  scenario.model = root.path("model");
  scenario.robot = read_model(scenario.model);
  scenario.assumed = scenario.robot;
  if (!robot.empty()) scenario.robot = read_robot(robot, scenario.assumed->nominal, scenario.model);
  scenario.duration_s = root.number_or("duration", scenario.duration_s, "s", Sign::positive);
  scenario.seed = static_cast<std::uint64_t>(root.integer_or("seed", 1, 0, std::numeric_limits<std::int64_t>::max()));
  if (root.has("engine")) scenario.engine = root.choice("engine", words_of(Engine()));
  read_changes(root.children("set"), scenario.robot);
  if (const auto effects = root.optional_child("effects"))
    for (const PlacedEffect& e : read_effects(*effects, scenario.robot)) scenario.robot.effects.push_back(e);

  scenario.trajectory.resize(scenario.robot.n());
  std::vector<bool> given(scenario.robot.n(), false);
  for (const XmlElement& element : root.children("trajectory")) read_trajectory(element, scenario, given);
  for (int k = 0; k < scenario.robot.n(); ++k)  // a joint that is not told anything stays at home
    if (!given[k]) scenario.trajectory[k].center = scenario.robot.joints[k].home;

  if (const auto control = root.optional_child("control")) {
    control->only({"period", "fade_in"});
    scenario.control_period_s = control->number_or("period", scenario.control_period_s, "s", Sign::positive);
    scenario.fade_in_s = control->number_or("fade_in", scenario.fade_in_s, "s", Sign::non_negative);
  }
  if (const auto integrator = root.optional_child("integrator")) read_integrator(*integrator, scenario.integrator);
  if (const auto sensors = root.optional_child("sensors")) read_sensors(*sensors, scenario);
  if (const auto camera = root.optional_child("camera")) {
    camera->only({"rate", "latency", "noise", "dropout"});
    Camera c;
    c.rate_hz = camera->number_or("rate", c.rate_hz, "Hz", Sign::positive);
    c.latency_s = camera->number_or("latency", c.latency_s, "s", Sign::non_negative);
    c.noise_m = camera->number_or("noise", c.noise_m, "m", Sign::non_negative);
    c.dropout = camera->number_or("dropout", c.dropout, "", Sign::non_negative);
    if (c.dropout > 1) camera->fail("dropout", "expected a share of the frames, from 0 to 1");
    scenario.camera = c;
  }
  try {
    check_scenario(scenario);
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
  return scenario;
}

}  // namespace halyard
