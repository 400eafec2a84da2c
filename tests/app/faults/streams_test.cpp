// Standard streams that are closed, or go while a command runs. Outputs are complete all the same.
#include <gtest/gtest.h>

#include "tests/app/faults/faults.h"

namespace halyard::testing_program {
namespace {

class FaultsOfStreams : public Faults {};

TEST_F(FaultsOfStreams, AClosedPipeIsAnErrorWithCompleteOutputs) {
  for (const Arguments& command : commands()) {
    SCOPED_TRACE(line_of(command));
    const Files whole = files_of(command);
    int pipe[2];
    ASSERT_EQ(::pipe2(pipe, O_CLOEXEC), 0);
    BackgroundRun run(program_, folder_, command, err_path(), pipe[1]);
    ::close(pipe[0]);
    ::close(pipe[1]);
    EXPECT_EQ(run.wait(), 1);
    expect_line(text_of(err_path()), "stdout: cannot be written: Broken pipe");
    EXPECT_TRUE(files_in(path("out")) == whole);
    fs::remove_all(path("out"));
  }
  fs::remove(err_path());
}

TEST_F(FaultsOfStreams, AClosedStreamTakesNoPartOfTheOutputs) {
  done({"simulate", "experiment_a.xml", "--out", "open/log.csv"});
  const std::string command = "cd '" + folder_.string() + "' && '" + program_.string() +
                              "' simulate experiment_a.xml --out closed/log.csv >&- 2>&-";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1) << "the summary cannot be printed";
  EXPECT_TRUE(files_in(path("closed")) == files_in(path("open")));
}

TEST_F(FaultsOfStreams, ATerminalThatGoesEndsNoRun) {
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_TRUE(terminal >= 0 && ::grantpt(terminal) == 0 && ::unlockpt(terminal) == 0);
  BackgroundRun run(program_, folder_, {"sweep", "sweep.xml", "--out", "out", "--jobs", "1"}, ::ptsname(terminal));
  ASSERT_TRUE(comes_true([&] { return fs::exists(path("out/cells/all.jsonl")); }));
  ::close(terminal);
  EXPECT_EQ(run.wait(), 0);
  EXPECT_TRUE(fs::exists(path("out/sweep.csv")));
}

}  // namespace
}  // namespace halyard::testing_program
