#include "model/column_map.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "model/input/cell_text.h"
#include "model/input_error.h"

namespace halyard {
namespace {

enum class Quantity { kTime, kPosition, kVelocity, kEffort };

struct Unit {
  std::string_view name;
  Quantity quantity;
  double si;  // SI unit per unit
};

constexpr double kTurn = 2 * std::numbers::pi;

constexpr std::array kUnits = {
    Unit{"s", Quantity::kTime, 1},
    Unit{"ms", Quantity::kTime, 1e-3},
    Unit{"us", Quantity::kTime, 1e-6},
    Unit{"rad", Quantity::kPosition, 1},
    Unit{"deg", Quantity::kPosition, kTurn / 360},
    Unit{"turn", Quantity::kPosition, kTurn},
    Unit{"m", Quantity::kPosition, 1},
    Unit{"mm", Quantity::kPosition, 1e-3},
    Unit{"um", Quantity::kPosition, 1e-6},
    Unit{"rad/s", Quantity::kVelocity, 1},
    Unit{"deg/s", Quantity::kVelocity, kTurn / 360},
    Unit{"rpm", Quantity::kVelocity, kTurn / 60},
    Unit{"m/s", Quantity::kVelocity, 1},
    Unit{"mm/s", Quantity::kVelocity, 1e-3},
    Unit{"N.m", Quantity::kEffort, 1},
    Unit{"mN.m", Quantity::kEffort, 1e-3},
    Unit{"N.mm", Quantity::kEffort, 1e-3},
    Unit{"N", Quantity::kEffort, 1},
    Unit{"A", Quantity::kEffort, 1},
    Unit{"mA", Quantity::kEffort, 1e-3},
    Unit{"V", Quantity::kEffort, 1},
    Unit{"mV", Quantity::kEffort, 1e-3},
};

/// "1", "2", ... without leading zeros, of at most 9 digits.
bool is_joint_number(std::string_view text) {
  return !text.empty() && text.size() < 10 && text.front() != '0' &&
         text.find_first_not_of("0123456789") == std::string_view::npos;
}

bool is_marker(std::string_view name) { return std::ranges::find(kMarkerNames, name) != kMarkerNames.end(); }

std::optional<Quantity> quantity_of(std::string_view name) {
  if (name == "time") return Quantity::kTime;
  if (is_marker(name)) return Quantity::kPosition;
  const auto split = name.rfind('_');
  if (split == std::string_view::npos || !is_joint_number(name.substr(split + 1))) return std::nullopt;
  const std::string_view signal = name.substr(0, split);
  for (const std::string_view known : kSignalNames) {
    if (signal != known) continue;
    if (signal.ends_with("position")) return Quantity::kPosition;
    return signal.ends_with("velocity") ? Quantity::kVelocity : Quantity::kEffort;
  }
  return std::nullopt;
}

std::string standard_names() {
  std::string names = "time";
  for (const std::string_view signal : kSignalNames) names.append(", ").append(signal).append("_k");
  names += " (k = 1 for the first joint)";
  for (const std::string_view marker : kMarkerNames) names.append(", ").append(marker);
  return names;
}

/// Throws InputError for a name that is no standard column.
Quantity standard_quantity(std::string_view name) {
  if (const std::optional<Quantity> quantity = quantity_of(name)) return *quantity;
  throw InputError(in_quotes(name) + " is no column of a log; expected one of " + standard_names());
}

double unit_factor(std::string_view unit, Quantity quantity) {
  if (unit.empty()) return 1;
  std::string fitting;
  for (const Unit& known : kUnits) {
    if (known.quantity != quantity) continue;
    if (known.name == unit) return known.si;
    fitting.append(fitting.empty() ? "" : ", ").append(known.name);
  }
  throw InputError("unit " + in_quotes(unit) + ": expected one of " + fitting +
                   "; for any other unit leave it out and give a scale to SI");
}

double number_of(std::string_view key, std::string_view text) {
  const std::optional<double> number = parse_number(text);
  if (!number) throw InputError(std::string(key) + " " + in_quotes(text) + ": expected a number, such as 0.0816");
  return *number;
}

/// The trimmed texts before and after the first '='; throws if there is none.
std::pair<std::string_view, std::string_view> key_and_value(std::string_view text) {
  const auto equals = text.find('=');
  if (equals == std::string_view::npos) {
    throw InputError(in_quotes(text) +
                     " has no '='; expected NAME=COLUMN, such as motor_position_1=spindle_rad,sign=-1");
  }
  return {trim(text.substr(0, equals)), trim(text.substr(equals + 1))};
}

void add_parsed(ColumnMap& map, std::string_view entry) {
  std::vector<std::string_view> parts;
  split(entry, parts);
  const auto [name, column] = key_and_value(parts.front());
  std::string_view unit;
  std::map<std::string_view, double> numbers = {{"sign", 1}, {"scale", 1}, {"offset", 0}, {"wrap", 0}};
  std::set<std::string_view> given;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const auto [key, value] = key_and_value(parts[i]);
    if (!given.insert(key).second) throw InputError(in_quotes(key) + " is given twice; give it once");
    if (key == "unit") {
      unit = value;
    } else if (numbers.contains(key)) {
      numbers[key] = number_of(key, value);
    } else {
      throw InputError(in_quotes(key) + " is no setting of a column; expected unit=, sign=, scale=, offset= or wrap=");
    }
  }
  if (column.empty() && parts.size() == 1) return map.leave_out(name);
  map.add(name, column, unit, numbers["sign"], numbers["scale"], numbers["offset"], numbers["wrap"]);
}

}  // namespace

void ColumnMap::insert(std::string_view name, const ColumnSource& source) {
  if (!sources_.emplace(name, source).second) throw InputError("is mapped twice; remove one of the two");
}

void ColumnMap::leave_out(std::string_view name) {
  standard_quantity(name);
  try {
    if (name == "time" || name.starts_with("motor_position_"))
      throw InputError("no column is named, but every log has it; name the column of the file that it comes from");
    insert(name, {});
  } catch (const InputError& error) {
    throw InputError("column " + in_quotes(name) + ": " + error.what());
  }
}

void ColumnMap::add(std::string_view name, std::string_view column, std::string_view unit, double sign, double scale,
                    double offset, double wrap) {
  const Quantity quantity = standard_quantity(name);
  unit = trim(unit);
  try {
    if (trim(column).empty()) throw InputError("no column is named; name the column of the file that it comes from");
    if (sign != 1 && sign != -1) throw InputError("expected sign 1 or -1; other factors belong in scale");
    const double factor = sign * scale * unit_factor(unit, quantity);
    if (!std::isfinite(factor) || factor == 0) throw InputError("expected a finite scale other than 0");
    if (!std::isfinite(offset)) throw InputError("expected a finite offset, in SI units");
    if (!std::isfinite(wrap) || wrap < 0)
      throw InputError(
          "expected a wrap of at least 0: the period of the reading, in the units of the file; 0 means none");
    if (wrap > 0 && (quantity != Quantity::kPosition || is_marker(name)))
      throw InputError("only a motor's or a joint's position wraps around; leave wrap out here");
    const bool is_electric = scale == 1 && (unit.ends_with('A') || unit.ends_with('V'));
    insert(name, {std::string(trim(column)), factor, offset, wrap, is_electric ? std::string(unit) : ""});
  } catch (const InputError& error) {
    throw InputError("column " + in_quotes(name) + ": " + error.what());
  }
}

void ColumnMap::add_entry(std::string_view entry) {
  try {
    add_parsed(*this, entry);
  } catch (const InputError& error) {
    throw InputError("column map " + in_quotes(entry) + ": " + error.what());
  }
}

void ColumnMap::override_with(const ColumnMap& other) {
  for (const auto& [name, source] : other.sources_) sources_.insert_or_assign(name, source);
}

void ColumnMap::check_joints(int n_joints) const {
  for (const auto& [name, source] : sources_) {
    if (name == "time" || is_marker(name) || std::stoi(name.substr(name.rfind('_') + 1)) <= n_joints) continue;
    throw InputError("column map: " + in_quotes(name) + ": the last joint of the arm is " + std::to_string(n_joints) +
                     "; remove this column from the map");
  }
}

}  // namespace halyard
