#include "evaluation/sweep/sweep_store.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "evaluation/json.h"
#include "evaluation/sweep/sweep_cells.h"
#include "model/input/text_file.h"
#include "model/input_error.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kTargets[] = {"robot", "model", "both"};

fs::path grid_path(const fs::path& folder) { return folder / "sweep.json"; }

/// Reads a JSON file and hands it to parse; any flaw, which parse throws as std::invalid_argument or the library as its
/// own, becomes one InputError.
template <class Parse>
auto read_json(const fs::path& path, Parse parse) {
  const auto damaged = [&] {
    return InputError(path.string() +
                      ": is no result of halyard sweep or is damaged; remove it and run the sweep again");
  };
  const std::string text = read_text_file(
      path, {.name = "a result of halyard sweep", .if_too_large = "merge it where more memory is", .is_input = false});
  try {
    return parse(ordered_json::parse(text));
  } catch (const ordered_json::exception&) {
    throw damaged();
  } catch (const std::invalid_argument&) {
    throw damaged();
  }
}

SweepAxis::Target target_of(const std::string& name) {
  for (int i = 0; i < 3; ++i) {
    if (name == kTargets[i]) return static_cast<SweepAxis::Target>(i);
  }
  throw std::invalid_argument("unknown target");
}

ordered_json to_json(const SweepAxis& axis) {
  return {{"parameters", axis.parameters},
          {"applies_to", kTargets[static_cast<int>(axis.applies_to)]},
          {"factor", axis.is_factor},
          {"logarithmic", axis.is_logarithmic},
          {"unit", axis.unit},
          {"values", axis.values}};
}

SweepAxis axis_of(const ordered_json& json) {
  SweepAxis axis;
  axis.parameters = json.at("parameters").get<std::vector<std::string>>();
  axis.applies_to = target_of(json.at("applies_to").get<std::string>());
  axis.is_factor = json.at("factor").get<bool>();
  axis.is_logarithmic = json.at("logarithmic").get<bool>();
  axis.unit = json.at("unit").get<std::string>();
  axis.values = json.at("values").get<std::vector<double>>();
  if (axis.parameters.empty() || axis.values.empty()) throw std::invalid_argument("an empty axis");
  return axis;
}

SweepEffect effect_of(const ordered_json& json) {
  return {json.at("effect").get<std::string>(), json.at("parameter").get<std::string>(),
          json.at("units").get<std::vector<std::string>>()};
}

std::vector<const SweepMeasure*> measures_of(const ordered_json& json) {
  try {
    return parse_measures(fmt::format("{}", fmt::join(json.get<std::vector<std::string>>(), ",")));
  } catch (const InputError&) {
    throw std::invalid_argument("unknown measures");
  }
}

}  // namespace

void refuse_other_sweep(const fs::path& folder, const SweepGrid& grid) {
  if (fs::exists(grid_path(folder)) && read_grid(folder).id != grid.id)
    throw InputError(folder.string() +
                     ": holds results of another sweep, or of this one before its files were changed; remove it, or "
                     "give another folder");
}

void write_grid(OutputFiles& files, const fs::path& folder, const SweepGrid& grid) {
  ordered_json axes = ordered_json::array(), joints = ordered_json::array();
  for (const SweepAxis& axis : grid.axes) axes.push_back(to_json(axis));
  for (const JointUnit& unit : grid.units) {
    joints.push_back({{"unit", unit.si}, {"shown", unit.shown}, {"shown_per_si", unit.shown_per_si}});
  }
  ordered_json measures = ordered_json::array();
  for (const SweepMeasure* measure : grid.measures) measures.push_back(measure->name);
  ordered_json effects = ordered_json::array();
  for (const SweepEffect& effect : grid.effects)
    effects.push_back({{"effect", effect.name}, {"parameter", effect.parameter}, {"units", effect.units}});
  const ordered_json json = {{"sweep", grid.name},
                             {"id", grid.id},
                             {"file", grid.file},
                             {"scenario", grid.scenario},
                             {"model", grid.model},
                             {"effect_modules", grid.effect_modules},
                             {"errors_counted_after_s", grid.skip_s},
                             {"points", grid.size()},
                             {"sampled", grid.is_sampled},
                             {"seeds", grid.seeds},
                             {"axes", axes},
                             {"estimators", grid.estimators},
                             {"effects", effects},
                             {"measures", measures},
                             {"joints", joints}};
  files.add(grid_path(folder), json_text(json));
}

SweepGrid read_grid(const fs::path& folder) {
  if (!fs::exists(grid_path(folder))) {
    throw InputError(folder.string() + ": holds no sweep.json; give a folder that halyard sweep wrote");
  }
  return read_json(grid_path(folder), [](const ordered_json& json) {
    SweepGrid grid;
    grid.name = json.at("sweep").get<std::string>();
    grid.id = json.at("id").get<std::string>();
    grid.file = json.at("file").get<std::string>();
    grid.scenario = json.at("scenario").get<std::string>();
    grid.model = json.at("model").get<std::string>();
    grid.effect_modules = json.value("effect_modules", std::vector<std::string>{});  // earlier programs wrote none
    grid.skip_s = json.at("errors_counted_after_s").get<double>();
    for (const ordered_json& axis : json.at("axes")) grid.axes.push_back(axis_of(axis));
    grid.is_sampled = json.at("sampled").get<bool>();
    for (const ordered_json& seed : json.at("seeds")) grid.seeds.push_back(whole_number(seed));
    grid.estimators = json.at("estimators").get<std::vector<std::string>>();
    // Earlier programs wrote neither, and measured errors.
    for (const ordered_json& effect : json.value("effects", ordered_json::array()))
      grid.effects.push_back(effect_of(effect));
    if (grid.measures_limits()) grid.measures = {&limits_measure()};
    else if (json.contains("measures")) grid.measures = measures_of(json.at("measures"));
    for (const ordered_json& joint : json.at("joints")) {
      grid.units.push_back({joint.at("unit").get<std::string>(), joint.at("shown").get<std::string>(),
                            joint.at("shown_per_si").get<double>()});
    }
    for (const SweepEffect& effect : grid.effects)
      if (effect.units.size() != grid.units.size()) throw std::invalid_argument("a unit of a limit is missing");
    for (const SweepAxis& axis : grid.axes)
      if (grid.is_sampled && axis.values.size() != grid.axes.front().values.size())
        throw std::invalid_argument("samples are missing");
    double points = double(grid.n_seeds());
    for (const SweepAxis& axis : grid.axes)
      if (!grid.is_sampled || &axis == &grid.axes.front()) points *= double(axis.values.size());
    if (points > kMostSweepPoints) throw std::invalid_argument("more points than a sweep can have");
    if (grid.axes.empty() || grid.size() != whole_number(json.at("points"))) {
      throw std::invalid_argument("the number of points is not that of the axes");
    }
    return grid;
  });
}

void store_grid(const fs::path& folder, const SweepGrid& grid) {
  refuse_other_sweep(folder, grid);
  if (fs::exists(grid_path(folder))) return;  // shards start at the same time
  OutputFiles files;
  write_grid(files, folder, grid);
  files.commit();
}

}  // namespace halyard
