// Folders: the output's, the home and the temporary one.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/app/faults/faults.h"

namespace halyard::testing_program {
namespace {

class FaultsOfFolders : public Faults {
 protected:
  void SetUp() override {
    Faults::SetUp();
    fs::create_directories(path("read_only"));
    ::chmod(path("read_only").c_str(), 0555);
  }
};

TEST_F(FaultsOfFolders, AnOutputBelowAFileIsRefusedAtOnce) {
  for (Arguments command : commands()) {
    SCOPED_TRACE(line_of(command));
    const fs::path file = fs::path(command.back()).filename();
    command.back() = "log.csv" + (file.has_extension() ? "/" + file.string() : "");
    const Files before = files_in(folder_);
    const RunResult result = run(command);
    EXPECT_EQ(result.exit_code, 2);
    expect_line(result.err, "is not a folder");
    EXPECT_TRUE(files_in(folder_) == before) << "files were left or changed";
  }
}

TEST_F(FaultsOfFolders, AFolderThatCannotBeWrittenIsRefusedAtOnce) {
  if (!runs_as_nobody()) GTEST_SKIP() << "the program cannot be run as a user without rights";
  for (Arguments command : commands()) {
    SCOPED_TRACE(line_of(command));
    const fs::path file = fs::path(command.back()).filename();
    for (const std::string below : {"", "/new"}) {
      command.back() = "read_only" + below + (file.has_extension() ? "/" + file.string() : "");
      const RunResult result = run(command, as_nobody());
      EXPECT_EQ(result.exit_code, 2);
      expect_line(result.err, "no permission to write");
      EXPECT_TRUE(fs::is_empty(path("read_only")));
    }
  }
}

TEST_F(FaultsOfFolders, NeitherHomeNorTemporaryFolderIsNeeded) {
  if (!runs_as_nobody()) GTEST_SKIP() << "the program cannot be run as a user without rights";
  const std::string first = "unset HOME; TMPDIR='" + path("read_only").string() + "'; export TMPDIR; ";
  for (const Arguments& command : commands()) {
    SCOPED_TRACE(line_of(command));
    const Files whole = files_of(command);
    fs::create_directories(path("out"));
    ::chmod(path("out").c_str(), 0777);
    const RunResult result = run(command, first + as_nobody());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_TRUE(files_in(path("out")) == whole);
    EXPECT_TRUE(fs::is_empty(path("read_only")));
    fs::remove_all(path("out"));
  }
}

}  // namespace
}  // namespace halyard::testing_program
