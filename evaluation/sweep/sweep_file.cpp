#include "evaluation/sweep/sweep_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include "evaluation/estimator_list.h"
#include "evaluation/sweep/measures/sweep_limits.h"
#include "evaluation/sweep/parameters/axis_keys.h"
#include "evaluation/sweep/sweep_design.h"
#include "model/input/text_file.h"
#include "model/input_error.h"
#include "model/model_file.h"
#include "model/xml/xml_reader.h"
#include "plant/simulate.h"
#include "plugins/host/effect_module.h"
#include "plugins/host/loader.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;
using Target = SweepAxis::Target;

constexpr std::int64_t kMaxSteps = 100'000;
constexpr std::size_t kCheckedPoints = 2'000;

/// Values at these places between the axis' ends, 0 to 1. Both ends are exactly as written.
std::vector<double> values_at(const XmlElement& axis, bool is_logarithmic, const std::vector<double>& places) {
  const double from = axis.number("from", "", is_logarithmic ? Sign::positive : Sign::any);
  const double to = axis.number("to", "", is_logarithmic ? Sign::positive : Sign::any);
  std::vector<double> values;
  for (const double place : places) {
    if (place == 0 || place == 1) values.push_back(place == 0 ? from : to);
    else values.push_back(is_logarithmic ? from * std::pow(to / from, place) : from + place * (to - from));
  }
  return values;
}

/// Values of an axis of a grid.
std::vector<double> read_values(const XmlElement& axis, bool is_logarithmic) {
  const bool has_range = axis.has("from") || axis.has("to") || axis.has("steps");
  if (axis.has("values") == has_range) {
    axis.fail("expected either values=\"1 2 3\", or from, to and steps; give one of them");
  }
  if (axis.has("values")) return axis.numbers("values", "");
  const std::int64_t steps = axis.integer("steps", 2, kMaxSteps);
  std::vector<double> places;
  for (std::int64_t i = 0; i < steps; ++i) places.push_back(double(i) / double(steps - 1));
  return values_at(axis, is_logarithmic, places);
}

/// Values of an axis of samples.
std::vector<double> read_sampled_values(const XmlElement& axis, bool is_logarithmic,
                                        const std::vector<double>& places) {
  for (const char* name : {"values", "steps"})
    if (axis.has(name)) axis.fail(name, "belongs to a grid; give from and to, or leave out design");
  return values_at(axis, is_logarithmic, places);
}

/// The samples that the element asks for; nothing for a grid.
UnitSamples read_design(const XmlElement& element, std::uint64_t seed) {
  enum class Design { grid, latin_hypercube, sobol };
  const auto design = element.choice_or<Design>(
      "design", Design::grid,
      {{"grid", Design::grid}, {"latin_hypercube", Design::latin_hypercube}, {"sobol", Design::sobol}});
  if (design == Design::grid) {
    if (element.has("samples")) element.fail("samples", "a grid has none; add design=\"sobol\" or \"latin_hypercube\"");
    return {};
  }
  const auto samples = std::size_t(element.integer("samples", 2, std::int64_t(kMostSweepPoints)));
  const std::size_t axes = element.children("axis").size();
  return design == Design::sobol ? sobol_sequence(axes, samples) : latin_hypercube(axes, samples, seed);
}

/// Seeds of the repeats, from the scenario's on; nothing without repeats.
std::vector<std::uint64_t> read_seeds(const XmlElement& element, std::uint64_t first) {
  std::vector<std::uint64_t> seeds(std::size_t(element.integer_or("repeats", 1, 1, kMaxSteps)));
  if (seeds.size() == 1) return {};
  std::iota(seeds.begin(), seeds.end(), first);
  return seeds;
}

/// Whether an earlier axis varies the number at the same place.
bool is_taken(const SweepGrid& grid, const SweepAxis& axis, const std::string& key) {
  return std::ranges::any_of(grid.axes, [&](const SweepAxis& earlier) {
    const bool same_place =
        earlier.applies_to == axis.applies_to || earlier.applies_to == Target::both || axis.applies_to == Target::both;
    return same_place && std::ranges::find(earlier.parameters, key) != earlier.parameters.end();
  });
}

/// samples: of all axes; empty for a grid.
SweepAxis read_axis(const XmlElement& element, const Sweep& sweep, const UnitSamples& samples) {
  element.only({"parameter", "values", "from", "to", "steps", "scale", "factor", "applies_to"});
  SweepAxis axis;
  std::istringstream keys(element.text("parameter"));
  axis.parameters.assign(std::istream_iterator<std::string>(keys), {});
  axis.applies_to = element.choice_or<Target>(
      "applies_to", Target::both, {{"robot", Target::robot}, {"model", Target::model}, {"both", Target::both}});
  axis.is_factor = element.flag_or("factor", false);
  axis.is_logarithmic = element.choice_or<bool>("scale", false, {{"linear", false}, {"log", true}});
  axis.values = samples.empty() ? read_values(element, axis.is_logarithmic)
                                : read_sampled_values(element, axis.is_logarithmic, samples[sweep.grid.axes.size()]);
  for (const std::string& key : axis.parameters) {
    for (const SweepEffect& limited : sweep.grid.effects)
      if (key.find(".effect." + limited.name + ".") != key.npos)
        element.fail("parameter", in_quotes(key) +
                                      " puts an effect into the model whose limits are measured; vary "
                                      "another number");
    if (std::ranges::count(axis.parameters, key) > 1 || is_taken(sweep.grid, axis, key)) {
      element.fail("parameter", in_quotes(key) + " is varied twice; vary each number once");
    }
    try {
      const std::string unit = unit_of_key(key, axis, sweep.scenario, sweep.model, sweep.grid.estimators);
      if (axis.is_factor) continue;
      if (key != axis.parameters.front() && unit != axis.unit) {
        throw InputError(
            fmt::format("parameter {}: is in {}, and the first one in {}; give them axes of their own, or "
                        "factor=\"true\"",
                        in_quotes(key), unit.empty() ? "no unit" : unit, axis.unit.empty() ? "no unit" : axis.unit));
      }
      axis.unit = unit;
    } catch (const InputError& error) {
      element.fail("parameter", error.what());
    }
  }
  const auto stays_zero = [&](const std::string& key) { return is_zero(key, axis, sweep.scenario, sweep.model); };
  if (axis.is_factor && std::ranges::all_of(axis.parameters, stays_zero)) {
    element.fail("parameter", "parameter " + in_quotes(axis.parameters.front()) +
                                  ": is 0 or absent, and so is every multiple of it; give it a value in its own file, "
                                  "or leave out factor");
  }
  return axis;
}

/// Nothing for what is no file: whoever opens it says so.
std::string file_text(const fs::path& path) {
  if (!fs::is_regular_file(path)) return "";
  return read_text_file(path, {.name = "a file that the sweep uses", .if_too_large = "use a smaller one"});
}

/// What modules of estimators and effects contain: another build of them gives other results.
std::string modules_text(const Sweep& sweep) {
  std::string text = HALYARD_VERSION;
  for (const std::string& name : sweep.grid.estimators)
    if (is_module_path(name)) text += file_text(sweep.opened_by(name));
  // An axis or a limit may name the only effect of a module.
  for (const fs::path& module : loaded_effect_modules()) text += file_text(module);
  return text;
}

/// Everything that results depend on: also the controller's model, which need be neither the robot's nor the
/// estimators', and samples of trajectories, which may stand in files of their own.
std::string definition_id(const Sweep& sweep, const fs::path& sweep_file, const fs::path& scenario_file) {
  std::string text = file_text(sweep_file) + file_text(scenario_file) + model_to_xml(sweep.scenario.robot) +
                     model_to_xml(sweep.scenario.assumed.value()) + model_to_xml(sweep.model) + modules_text(sweep);
  for (const JointTrajectory& trajectory : sweep.scenario.trajectory) {
    for (std::size_t i = 0; i < trajectory.sample_time.size(); ++i) {
      text += exact_text(trajectory.sample_time[i]) + " " + exact_text(trajectory.sample_position[i]) + "\n";
    }
  }
  const boost::uuids::name_generator_sha1 generate(boost::uuids::ns::oid());
  return boost::uuids::to_string(generate(text));
}

std::vector<std::string> read_estimators(const XmlElement& element) {
  const std::string listed = element.text("estimators");
  try {
    return split_estimators(listed);
  } catch (const InputError& error) {
    element.fail("estimators", error.what());
  }
}

std::vector<const SweepMeasure*> read_measures(const XmlElement& element) {
  const std::string listed = element.text_or("measures", sweep_measures().front().name);
  try {
    return parse_measures(listed);
  } catch (const InputError& error) {
    element.fail("measures", error.what());
  }
}

/// The estimators with their measures, or the effects whose limits are measured.
void read_subjects(const XmlElement& element, const ArmModel& model, SweepGrid& grid) {
  if (!element.has("limits")) {
    grid.estimators = read_estimators(element);
    grid.measures = read_measures(element);
    return;
  }
  for (const char* name : {"estimators", "measures", "skip"})
    if (element.has(name)) element.fail(name, "has no meaning beside limits; leave one of them out");
  for (const XmlElement& axis : element.children("axis"))
    if (axis.text_or("applies_to", "") == "robot")
      axis.fail("applies_to", "detection limits are those of an arm as the model says; leave it out");
  grid.measures = {&limits_measure()};
  const std::string limited = element.text("limits");
  try {
    grid.effects = parse_limited_effects(limited, model);
  } catch (const InputError& error) {
    element.fail("limits", error.what());
  }
}

}  // namespace

std::string Sweep::opened_by(const std::string& estimator) const {
  if (!is_module_path(estimator) || fs::path(estimator).is_absolute()) return estimator;
  // "./" keeps a bare file name a path.
  return ((folder.empty() ? fs::path(".") : folder) / estimator).string();
}

Scenario Sweep::scenario_at(std::size_t point) const {
  Scenario changed = scenario;
  put_values(grid, point, changed);
  changed.seed = grid.seed(point).value_or(scenario.seed);
  return changed;
}

ArmModel Sweep::model_at(std::size_t point) const {
  ArmModel changed = model;
  put_values(grid, point, changed);
  return changed;
}

/// The checks of a model file and of a scenario.
void check_point(const Sweep& sweep, std::size_t point, const std::string& source) {
  const std::string where = source + ", at " + sweep.grid.description(point);
  const Scenario scenario = sweep.scenario_at(point);
  parse_model(model_to_xml(scenario.robot), where + ", robot");
  parse_model(model_to_xml(sweep.model_at(point)), where + ", model");
  try {
    check_varied_scenario(sweep.grid, scenario);
  } catch (const InputError& error) {
    throw InputError(where + ", " + error.what());
  }
}

Sweep read_sweep(const fs::path& path) {
  Sweep sweep = read_sweep_definition(path);
  const std::size_t points = sweep.grid.size(), stride = (points + kCheckedPoints - 1) / kCheckedPoints;
  for (std::size_t point = 0; point < points; point += stride) check_point(sweep, point, path.string());
  return sweep;
}

Sweep read_sweep_definition(const fs::path& path) {
  const XmlElement element = XmlElement::read_file(path, "sweep");
  element.only({"name", "scenario", "model", "estimators", "seed", "duration", "skip", "design", "samples", "repeats",
                "measures", "limits"},
               {"axis"});
  const fs::path scenario_file = element.path("scenario");
  Sweep sweep;
  sweep.folder = path.parent_path();
  sweep.scenario = read_scenario(scenario_file);
  sweep.scenario.seed = static_cast<std::uint64_t>(element.integer_or(
      "seed", static_cast<std::int64_t>(sweep.scenario.seed), 0, std::numeric_limits<std::int64_t>::max()));
  if (element.has("duration")) {
    sweep.scenario.duration_s = element.number("duration", "s", Sign::positive);
    try {
      check_scenario(sweep.scenario);
    } catch (const InputError& error) {
      element.fail("duration", error.what());
    }
  }
  const fs::path model_file = element.has("model") ? element.path("model") : sweep.scenario.model;
  sweep.model = read_model(model_file);
  if (!joints_alike(sweep.model.nominal, sweep.scenario.robot.nominal))
    element.fail("model",
                 "its joints are not those of the scenario's robot; give a model with as many joints, of the "
                 "same types and driven alike");

  SweepGrid& grid = sweep.grid;
  grid.name = element.text("name");
  grid.file = path.filename().string();
  grid.scenario = scenario_file.filename().string();
  grid.model = model_file.filename().string();
  grid.skip_s = element.number_or("skip", 0.5, "s", Sign::non_negative);
  grid.units = joint_units(sweep.model);
  read_subjects(element, sweep.model, grid);
  grid.seeds = read_seeds(element, sweep.scenario.seed);
  if (element.children("axis").empty()) element.fail("element <axis> is missing; give one or more");
  const UnitSamples samples = read_design(element, sweep.scenario.seed);
  grid.is_sampled = !samples.empty();
  double points = double(grid.n_seeds());
  for (const XmlElement& axis : element.children("axis")) {
    grid.axes.push_back(read_axis(axis, sweep, samples));
    if (!grid.is_sampled || grid.axes.size() == 1) points *= double(grid.axes.back().values.size());
  }
  if (points > kMostSweepPoints)
    element.fail(fmt::format("{:g} points; expected at most {:g}; take fewer values", points, kMostSweepPoints));
  if (!element.has("limits") && grid.skip_s >= sweep.scenario.duration_s)
    element.fail("skip",
                 fmt::format("{}expected less than the duration, {:g} s; of the first {:g} s no error is counted",
                             element.has("skip") ? "" : "skip: ", sweep.scenario.duration_s, grid.skip_s));
  for (const fs::path& module : loaded_effect_modules()) grid.effect_modules.push_back(module.filename().string());
  grid.id = definition_id(sweep, path, scenario_file);
  return sweep;
}

}  // namespace halyard
