#pragma once
/// Runs of the program that have to be refused.

#include "tests/support/program_run.h"

namespace halyard::testing_program {

inline const std::string kHeader =
    "time,motor_torque_1,motor_torque_2,motor_torque_3,motor_position_1,motor_position_2,motor_position_3\n";
inline const std::string kRows = "0,0,0,0,107,204,904\n0.001,0,0,0,107,204,904\n";

inline constexpr std::string_view kAny = "{any}";

/// Whether the text is the pattern, in which kAny stands for any text.
inline bool is_like(std::string_view text, std::string_view pattern) {
  const std::size_t any = pattern.find(kAny);
  if (any == pattern.npos) return text == pattern;
  const std::string_view rest = pattern.substr(any + kAny.size());
  return text.size() >= any + rest.size() && text.starts_with(pattern.substr(0, any)) && text.ends_with(rest);
}

/// Bytes of a message that fits on a screen, with its line break, are fewer.
inline constexpr std::size_t kScreen = 2000;

class BadInput : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_short_scenario("experiment_a.xml", "0.1");
    write_text(path("log.csv"), kHeader + kRows);
  }

  /// Runs, and expects exit code `code`, one line with all of `parts`, nothing on stdout, and the folder as it was.
  /// Returns the line.
  std::string expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& parts,
                             int code = 2) const {
    std::string command = "halyard";
    for (const std::string& argument : arguments) command += " " + argument.substr(0, 80);
    SCOPED_TRACE(command);
    const auto before = files_in(folder_);
    const RunResult result = run(arguments);
    EXPECT_EQ(result.exit_code, code);
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
    EXPECT_TRUE(result.err.ends_with('\n') && result.err.size() > 1);
    EXPECT_LT(result.err.size(), kScreen);
    for (const std::string& part : parts) EXPECT_TRUE(contains(result.err, part)) << result.err << "lacks: " << part;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(files_in(folder_) == before) << "files were left or changed";
    return result.err;
  }

  /// The same for a whole line, in which kAny stands for any text.
  void expect_line(const std::vector<std::string>& arguments, const std::string& line) const {
    const std::string err = expect_refused(arguments, {});
    EXPECT_TRUE(is_like(err, line + "\n")) << err << "expected:\n" << line;
  }

  void expect_estimate_refused(const std::string& data, const std::string& line) const {
    expect_line({"estimate", "--model", "raven2.xml", "--estimator", "kinematics", "--data", data, "--out", "est.csv"},
                line);
    expect_line({"compare", data, "--model", "raven2.xml", "--estimators", "kinematics", "--skip", "0", "--out", "cmp"},
                line);
  }

  /// Experiment A as moving.csv.
  void write_moving_log(const std::string& duration = "1") const {
    write_short_scenario("experiment_a.xml", duration);
    done({"simulate", "experiment_a.xml", "--out", "moving.csv"});
    fs::remove(path("moving.truth.csv"));
  }

  void expect_sweep_refused(const std::string& axes, const std::vector<std::string>& parts,
                            const std::string& attributes = "estimators=\"kinematics\" skip=\"0\"") const {
    write_text(path("bad.xml"),
               "<sweep name=\"bad\" scenario=\"experiment_a.xml\" " + attributes + ">" + axes + "</sweep>");
    expect_refused({"check", "bad.xml"}, parts);
    expect_refused({"sweep", "bad.xml", "--out", "out"}, parts);
  }
};

}  // namespace halyard::testing_program
