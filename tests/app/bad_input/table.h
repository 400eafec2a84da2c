#pragma once
/// The table of bad input: files that are each wrong in one way, and the line with which every command answers.

#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "tests/app/bad_input/bad_input.h"

namespace halyard::testing_program {

/// What the wrong file is, and so which commands have to refuse it.
enum class Wrong {
  model,     ///< commands that read a model
  options,   ///< options of an estimator in a model: commands that make this estimator
  scenario,  ///< commands that read a scenario
  sweep,     ///< commands that read a sweep
  log,       ///< commands that read a log
  clock,     ///< times of a log: commands that compute with them
  motion,    ///< a log that is right in form: commands that check it
};

/// Makes the wrong text from a right one: raven2.xml, experiment_a.xml of 0.1 s, a sweep, a log of three rows
/// (Wrong::log), or the log of a motion.
using Change = std::function<std::string(const std::string&)>;

struct BadInputRow {
  const char* name;
  Wrong wrong;
  Change change;
  std::string line;  ///< on stderr; kAny stands for any text
};
inline void PrintTo(const BadInputRow& row, std::ostream* out) { *out << row.name; }

inline Change put(const std::string& from, const std::string& to) {
  return [=](const std::string& text) { return replaced(text, from, to); };
}

/// Exchanges two names.
inline Change exchanged(const std::string& a, const std::string& b) {
  return [=](const std::string& text) { return replaced(replaced(replaced(text, a, "?"), b, a), "?", b); };
}

inline Change whole(const std::string& text) {
  return [=](const std::string&) { return text; };
}

/// `to` for each `from`.
inline Change all(const std::string& from, const std::string& to) {
  return [=](std::string text) {
    for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
    return text;
  };
}

/// change(row, value) for each value of these columns.
inline Change changed(const std::vector<std::string>& columns, const std::function<double(int, double)>& change) {
  return [=](const std::string& text) {
    std::string result;
    std::vector<bool> is_changed;
    int row = -1;
    for (const std::string& line : lines_of(text)) {
      if (line.starts_with('#')) continue;
      std::istringstream cells(line);
      std::size_t i = 0;
      for (std::string cell; std::getline(cells, cell, ','); ++i) {
        if (row < 0) is_changed.push_back(std::ranges::find(columns, cell) != columns.end());
        else if (is_changed[i]) cell = std::to_string(change(row, std::stod(cell)));
        result += (i == 0 ? "" : ",") + cell;
      }
      result += "\n";
      ++row;
    }
    return result;
  };
}

inline Change scaled(const std::vector<std::string>& columns, double factor) {
  return changed(columns, [=](int, double x) { return factor * x; });
}

/// The value of row `from` in all later rows.
inline Change frozen(const std::string& column, int from) {
  return changed({column}, [=, last = 0.0](int row, double x) mutable { return row <= from ? last = x : last; });
}

inline Change single(const std::string& column, int at, double value) {
  return changed({column}, [=](int row, double x) { return row == at ? value : x; });
}

inline const std::vector<std::string> kMotorColumns = {"motor_torque_1",   "motor_torque_2",   "motor_torque_3",
                                                       "motor_position_1", "motor_position_2", "motor_position_3"};

}  // namespace halyard::testing_program
