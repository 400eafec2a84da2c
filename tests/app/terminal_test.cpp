// What reaches the terminal: no control characters, whoever wrote the names, and no message longer than a screen.
#include "app/terminal/terminal.h"

#include "tests/support/app_runs.h"

namespace halyard::testing_program {
namespace {

// Red, in seven bits and as U+009B.
const std::string kEscape = "\x1b[31m", kCsi = "\u009b31m";

TEST(Terminal, ShowsControlCharactersAsQuestionMarks) {
  EXPECT_EQ(without_controls("a" + kEscape + "b" + kCsi + "c\x7f\td\n"), "a?[31mb?31mc??d\n");
  EXPECT_EQ(without_controls("\u0080\u009f\u00a0"), "??\u00a0");  // the first and the last of C1, and what follows
}

TEST(Terminal, ShowsTextInAnyScript) {
  for (const std::string text : {"Gr\u00f6\u00dfe", "\u20ac", "\u76ee", "\U0001f9be", "\U0010ffff"})
    EXPECT_EQ(without_controls(text), text);
}

TEST(Terminal, ShowsBytesThatAreNoTextAsQuestionMarks) {
  EXPECT_EQ(without_controls("\x9b[m"), "?[m");   // C1 in a character set of eight bits
  EXPECT_EQ(without_controls("\xe2\x82"), "??");  // ends within a character
  EXPECT_EQ(without_controls("\xc3z"), "?z");     // goes on with another character
  EXPECT_EQ(without_controls("\xc0\x9b"), "??");  // an escape and U+009B in more bytes than they need
  EXPECT_EQ(without_controls("\xe0\x82\x9b"), "???");
  EXPECT_EQ(without_controls("\xf0\x80\x82\x9b"), "????");
  EXPECT_EQ(without_controls("\xed\xa0\x80"), "???");       // half of a pair of UTF-16
  EXPECT_EQ(without_controls("\xf4\x90\x80\x80"), "????");  // beyond the last character
}

TEST(Terminal, AMessageIsOneLine) { EXPECT_EQ(one_message("a.xml:\n1\t" + kEscape), "a.xml: 1??[31m"); }

TEST(Terminal, OfALongMessageTheMiddleIsLeftOut) {
  const std::string fits(kMostOfMessage, 'x');
  EXPECT_EQ(one_message(fits), fits);
  const std::string shortened = one_message("place: " + fits + "; remedy");
  EXPECT_EQ(shortened.size(), kMostOfMessage);
  EXPECT_TRUE(shortened.starts_with("place: xxx") && shortened.ends_with("xxx; remedy")) << shortened;
  EXPECT_TRUE(contains(shortened, "x ... x"));
}

TEST(Terminal, NoCharacterIsCutInTwo) {
  std::string text;
  for (std::size_t i = 0; i < kMostOfMessage; ++i) text += "\u20ac";
  for (const std::string begin : {"", "a", "ab"}) {
    const std::string shortened = one_message(begin + text + begin);
    EXPECT_EQ(without_controls(shortened), shortened);
    EXPECT_GT(shortened.size(), kMostOfMessage - 6);
  }
}

class TerminalText : public App {
 protected:
  /// Runs, and expects a text on stdout or stderr, without control characters.
  void expect_shown(const std::vector<std::string>& arguments, const std::string& text) const {
    const RunResult result = run(arguments);
    const std::string shown = result.out + result.err;
    EXPECT_TRUE(contains(shown, text)) << shown;
    EXPECT_EQ(without_controls(shown), shown);
  }
};

TEST_F(TerminalText, ANameOfAScenarioHasNoControlCharacters) {
  write_short_scenario("experiment_a.xml", "0.1");
  const std::string name = "name=\"A: high tension\"";
  write_text(path("a.xml"), replaced(text_of(path("experiment_a.xml")), name, "name=\"A" + kCsi + "\""));
  expect_shown({"check", "a.xml"}, "valid scenario \"A?31m\"");
  expect_shown({"simulate", "a.xml", "--out", "log.csv"}, "scenario \"A?31m\"");
  write_text(path("b.xml"), replaced(text_of(path("a.xml")), "duration=\"0.1\"", "duration=\"1e-6\""));
  expect_shown({"check", "b.xml"}, "scenario 'A?31m': the duration must be");
}

TEST_F(TerminalText, AHeaderOfALogHasNoControlCharacters) {
  simulate_log();
  const std::string log = text_of(path("log.csv"));
  write_text(path("more.csv"), replaced(log, "joint_position_3", "a" + kCsi));
  expect_shown(
      {"estimate", "--model", "raven2.xml", "--estimator", "kinematics", "--data", "more.csv", "--out", "e.csv"},
      "columns that are not used: a?31m\n");
  write_text(path("less.csv"), replaced(log, "motor_torque_1", "a" + kCsi));
  expect_shown({"estimate", "--model", "raven2.xml", "--estimator", "ekf", "--data", "less.csv", "--out", "e.csv"},
               "the file has 'time', 'a?31m', ");
}

TEST_F(TerminalText, APathHasNoControlCharacters) {
  write_short_scenario("experiment_a.xml", "0.1");
  for (const std::string& red : {kEscape, kCsi}) {
    const std::string shown = without_controls(red);
    expect_shown({"simulate", "experiment_a.xml", "--out", "a" + red + ".csv"}, "measured log: a" + shown + ".csv\n");
    EXPECT_TRUE(fs::exists(path("a" + red + ".csv"))) << "the file's own name is as given";
    expect_shown({"check", red + ".xml"}, shown + ".xml: no such file");
  }
}

}  // namespace
}  // namespace halyard::testing_program
