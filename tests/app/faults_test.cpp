// Faults of every command that writes: another locale, another run. faults/ has one file for each other kind of fault.
#include <gtest/gtest.h>

#include <regex>

#include "tests/app/faults/faults.h"
#include "tests/support/german_locale.h"

namespace halyard::testing_program {
namespace {

/// What was printed, but how long a step took.
std::string without_times(const std::string& text) {
  return std::regex_replace(text, std::regex("[0-9.e+-]+ us a step"), "us a step");
}

TEST_F(Faults, ALocaleWithDecimalCommasChangesNothing) {
  if (!make_german_locale(path("locale"))) GTEST_SKIP() << kNoGermanLocale;
  // The program leaves its locale alone: what is preloaded sets it, as a program that embeds halyard may.
  const std::string german = "export LOCPATH='" + path("locale").string() + "' LC_ALL=" + kGermanLocale +
                             " ASAN_OPTIONS=$ASAN_OPTIONS:verify_asan_link_order=0 LD_PRELOAD=" HALYARD_SETS_LOCALE ";";
  write_short_scenario("experiment_b.xml", "3");
  done({"simulate", "experiment_b.xml", "--out", "b.csv"});
  std::vector<Arguments> all = quick_commands();
  all.push_back({"diagnose", "--model", "raven2.xml", "--data", "b.csv", "--out", "out"});
  all.push_back({"diagnose", "--plan", "raven2.xml", "experiment_b.xml", "--out", "out"});
  for (const Arguments& command : all) {
    SCOPED_TRACE(line_of(command));
    fs::remove_all(path("out"));
    const std::string usual = done(command);
    const auto files = files_in(path("out"));
    fs::remove_all(path("out"));
    const RunResult result = run(command, german);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(without_times(result.out), without_times(usual));
    EXPECT_TRUE(files_in(path("out")) == files);
  }
}

TEST_F(Faults, ASecondRunIntoAnOutputIsRefused) {
  // One run into a folder and one into files in it: they do not disturb each other.
  BackgroundRun into_folder(program_, folder_, long_runs()[1], err_path());
  BackgroundRun into_files(program_, folder_, long_runs()[0], err_path());
  ASSERT_TRUE(comes_true([&] { return fs::exists(path("out/.halyard.lock")); }));
  ASSERT_TRUE(comes_true([&] { return fs::exists(path("out/.halyard.log.truth.csv.lock")); }));
  for (Arguments command : commands()) {
    const bool writes_file = command.back() != "out";
    if (command[0] == "estimate") command.back() = "out/log.truth.csv";  // which `simulate` writes, too
    SCOPED_TRACE(line_of(command));
    const RunResult second = run(command);
    EXPECT_EQ(second.exit_code, 2);
    expect_line(second.err, writes_file ? "another run writes this file" : "another run writes into this folder");
  }
  done(quick_commands()[1]);
  for (BackgroundRun* first : {&into_folder, &into_files}) {
    first->send(SIGKILL);
    EXPECT_EQ(first->wait(), 128 + SIGKILL);
  }
  for (const std::size_t i : {0, 2}) done(quick_commands()[i]);
  EXPECT_EQ(files_in(path("out")).size(), 6u);  // log, truth and estimates; table, numbers and report
  fs::remove(err_path());
}

}  // namespace
}  // namespace halyard::testing_program
