#pragma once
/// Commands of the built program on short runs of the RAVEN-II.

#include "tests/support/program_run.h"

namespace halyard::testing_program {

inline const std::vector<std::string> kLogColumns = {"time",
                                                     "motor_torque_1",
                                                     "motor_torque_2",
                                                     "motor_torque_3",
                                                     "motor_position_1",
                                                     "motor_position_2",
                                                     "motor_position_3",
                                                     "joint_position_1",
                                                     "joint_position_2",
                                                     "joint_position_3"};

class App : public ProgramTest {
 protected:
  /// log.csv and log.truth.csv of 1 s of experiment A.
  void simulate_log() const {
    write_short_scenario("experiment_a.xml");
    done({"simulate", "experiment_a.xml", "--out", "log.csv"});
  }

  std::string estimate(const std::string& estimator, const std::string& data, const std::string& out,
                       std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"estimate", "--model", "raven2.xml", "--estimator", estimator, "--data",
                                          data,       "--out",   out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return done(arguments);
  }

  /// Writes a CSV table again with the columns that `keep` names, each cell through `change`.
  template <class Change>
  void rewrite(const std::string& from, const std::string& to, const std::vector<std::string>& keep,
               const std::vector<std::string>& names, const Change& change) const {
    const CsvFile table(path(from));
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
    text += "\n";
    for (const auto& row : table.rows) {
      std::string line;
      for (const std::string& name : keep) {
        if (!line.empty()) line += ',';
        line += change(name, row.at(table.index(name)));
      }
      text += line + "\n";
    }
    write_text(path(to), text);
  }
};

inline std::string as_is(const std::string&, const std::string& cell) { return cell; }

}  // namespace halyard::testing_program
