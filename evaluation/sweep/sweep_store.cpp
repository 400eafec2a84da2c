#include "evaluation/sweep/sweep_store.h"

#include <fmt/core.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "evaluation/json.h"
#include "model/input_error.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kTargets[] = {"robot", "model", "both"};

fs::path grid_path(const fs::path& folder) { return folder / "sweep.json"; }

fs::path cell_path(const fs::path& folder, std::size_t point) {
  return folder / "cells" / fmt::format("{:06}.json", point);
}

/// Reads a JSON file and hands it to parse; any flaw, which parse throws as std::invalid_argument or the library as its
/// own, becomes one InputError.
template <class Parse>
auto read_json(const fs::path& path, Parse parse) {
  const auto damaged = [&] {
    return InputError(path.string() +
                      ": is no result of halyard sweep or is damaged; remove it and run the sweep again");
  };
  try {
    std::ifstream file(path, std::ios::binary);
    return parse(ordered_json::parse(file));
  } catch (const ordered_json::exception&) {
    throw damaged();
  } catch (const std::invalid_argument&) {
    throw damaged();
  }
}

double number_of(const ordered_json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
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

ordered_json to_json(const ErrorStatistics& error) {
  return {{"samples", error.samples},
          {"mean_absolute_error", number_or_null(error.mean_absolute)},
          {"rms_error", number_or_null(error.rms)},
          {"peak_error", number_or_null(error.peak)},
          {"bias", number_or_null(error.bias)},
          {"within_two_std", number_or_null(error.within_two_std)}};
}

ErrorStatistics errors_of(const ordered_json& json) {
  ErrorStatistics error;
  error.samples = json.at("samples").get<std::size_t>();
  error.mean_absolute = number_of(json.at("mean_absolute_error"));
  error.rms = number_of(json.at("rms_error"));
  error.peak = number_of(json.at("peak_error"));
  error.bias = number_of(json.at("bias"));
  error.within_two_std = number_of(json.at("within_two_std"));
  return error;
}

}  // namespace

bool holds_other_sweep(const fs::path& folder, const SweepGrid& grid) {
  return fs::exists(grid_path(folder)) && read_grid(folder).id != grid.id;
}

void discard_other_sweep(OutputFiles& files, const fs::path& folder, const SweepGrid& grid) {
  if (!holds_other_sweep(folder, grid)) return;
  if (fs::exists(folder / "cells"))
    for (const auto& cell : fs::directory_iterator(folder / "cells")) files.remove(cell.path());
  for (const char* table : {"sweep.csv", "report.html"}) files.remove(folder / table);
}

void write_grid(OutputFiles& files, const fs::path& folder, const SweepGrid& grid) {
  ordered_json axes = ordered_json::array(), joints = ordered_json::array();
  for (const SweepAxis& axis : grid.axes) axes.push_back(to_json(axis));
  for (const JointUnit& unit : grid.units) {
    joints.push_back({{"unit", unit.si}, {"shown", unit.shown}, {"shown_per_si", unit.shown_per_si}});
  }
  const ordered_json json = {{"sweep", grid.name},
                             {"id", grid.id},
                             {"scenario", grid.scenario},
                             {"model", grid.model},
                             {"errors_counted_after_s", grid.skip_s},
                             {"points", grid.size()},
                             {"axes", axes},
                             {"estimators", grid.estimators},
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
    grid.scenario = json.at("scenario").get<std::string>();
    grid.model = json.at("model").get<std::string>();
    grid.skip_s = json.at("errors_counted_after_s").get<double>();
    for (const ordered_json& axis : json.at("axes")) grid.axes.push_back(axis_of(axis));
    grid.estimators = json.at("estimators").get<std::vector<std::string>>();
    for (const ordered_json& joint : json.at("joints")) {
      grid.units.push_back({joint.at("unit").get<std::string>(), joint.at("shown").get<std::string>(),
                            joint.at("shown_per_si").get<double>()});
    }
    if (grid.axes.empty() || grid.size() != json.at("points").get<std::size_t>()) {
      throw std::invalid_argument("the number of points is not that of the axes");
    }
    return grid;
  });
}

void write_cell(OutputFiles& files, const fs::path& folder, const SweepGrid& grid, const SweepCell& cell) {
  ordered_json results = ordered_json::array();
  for (std::size_t i = 0; i < cell.results.size(); ++i) {
    ordered_json joints = ordered_json::array();
    for (const ErrorStatistics& error : cell.results[i].errors) joints.push_back(to_json(error));
    results.push_back({{"estimator", grid.estimators[i]}, {"failure", cell.results[i].failure}, {"joints", joints}});
  }
  const ordered_json json = {
      {"id", grid.id}, {"point", cell.point}, {"values", grid.values(cell.point)}, {"estimators", results}};
  files.add(cell_path(folder, cell.point), json_text(json));
}

std::optional<SweepCell> read_cell(const fs::path& folder, const SweepGrid& grid, std::size_t point) {
  const fs::path path = cell_path(folder, point);
  if (!fs::exists(path)) return std::nullopt;
  return read_json(path, [&](const ordered_json& json) {
    if (json.at("id").get<std::string>() != grid.id) {
      throw InputError(path.string() + ": belongs to another sweep; give a folder of its own to each sweep");
    }
    if (const auto stored = json.at("point").get<std::size_t>(); stored != point) {
      throw InputError(fmt::format("{}: holds point {}, but its name says point {}; remove it and run the sweep again",
                                   path.string(), stored, point));
    }
    SweepCell cell{point, {}};
    for (const ordered_json& result : json.at("estimators")) {
      cell.results.push_back({result.at("failure").get<std::string>(), {}});
      for (const ordered_json& joint : result.at("joints")) cell.results.back().errors.push_back(errors_of(joint));
      if (cell.results.back().errors.size() != grid.units.size()) throw std::invalid_argument("joints are missing");
    }
    if (cell.results.size() != grid.estimators.size()) throw std::invalid_argument("estimators are missing");
    return cell;
  });
}

void remove_cell(const fs::path& folder, std::size_t point) { fs::remove(cell_path(folder, point)); }

}  // namespace halyard
