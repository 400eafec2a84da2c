/// Files that appear together or not at all, and the locks of a file and of a folder.

#include "model/output/output_files.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "model/output/file_lock.h"
#include "model/output/folder_lock.h"
#include "tests/support/background_run.h"
#include "tests/support/message_of.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

class OutputFolder : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string(test->name()) + "-" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  static std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  fs::path folder_;
};

std::string failure_message(const auto& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no failure";
}

TEST_F(OutputFolder, WithoutCommitThereIsNeitherFileNorFolder) {
  {
    OutputFiles out;
    out.add(folder_ / "new" / "log.csv", "text");
    EXPECT_FALSE(fs::exists(folder_ / "new" / "log.csv"));
    EXPECT_EQ(files(), 1u);
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(OutputFolder, WithoutCommitOlderFilesStay) {
  write_file_whole(folder_ / "log.csv", "old");
  {
    OutputFiles out;
    out.add(folder_ / "log.csv", "new");
    out.remove(folder_ / "log.csv");
  }
  EXPECT_EQ(content(folder_ / "log.csv"), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFolder, CommitReplacesTheFileAndLeavesNothingElse) {
  write_file_whole(folder_ / "log.csv", "old");
  write_file_whole(folder_ / "log.csv", std::string_view("new\0\n", 5));
  EXPECT_EQ(content(folder_ / "log.csv"), std::string("new\0\n", 5));
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFolder, CommitRemovesWhatHasNoPlaceBesideTheNewFiles) {
  for (const char* name : {"kept.csv", "replaced.csv", "obsolete.csv"}) write_file_whole(folder_ / name, "old");
  OutputFiles out;
  out.remove(folder_ / "obsolete.csv");
  out.remove(folder_ / "replaced.csv");
  out.add(folder_ / "replaced.csv", "new");
  EXPECT_TRUE(fs::exists(folder_ / "obsolete.csv"));
  out.commit();
  EXPECT_EQ(files(), 2u);
  EXPECT_EQ(content(folder_ / "replaced.csv"), "new");
}

// add() resolves the path of an older file, remove() does not.
TEST_F(OutputFolder, CommitKeepsANewFileThatIsAlsoRemovedByAnotherPath) {
  fs::create_directories(folder_ / "real");
  fs::create_directory_symlink("real", folder_ / "link");
  write_file_whole(folder_ / "real" / "table.csv", "old");
  OutputFiles out;
  out.remove(folder_ / "link" / "table.csv");
  out.add(folder_ / "link" / "table.csv", "new");
  out.commit();
  EXPECT_EQ(content(folder_ / "real" / "table.csv"), "new");
}

TEST_F(OutputFolder, AFileIsWrittenInParts) {
  OutputFiles out;
  out.add_in_parts(folder_ / "log.csv", [](const OutputFiles::Append& append) {
    append("one\n");
    append("two\n");
  });
  EXPECT_FALSE(fs::exists(folder_ / "log.csv"));
  out.commit();
  EXPECT_EQ(content(folder_ / "log.csv"), "one\ntwo\n");
}

TEST_F(OutputFolder, ParentFoldersAreCreated) {
  write_file_whole(folder_ / "a" / "b" / "report.html", "page");
  EXPECT_EQ(content(folder_ / "a" / "b" / "report.html"), "page");
}

TEST_F(OutputFolder, ALinkIsFollowedAndStaysALink) {
  write_file_whole(folder_ / "real.csv", "old");
  fs::create_symlink("real.csv", folder_ / "link.csv");
  write_file_whole(folder_ / "link.csv", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.csv"));
  EXPECT_EQ(content(folder_ / "real.csv"), "new");
}

TEST_F(OutputFolder, WhatCannotBeWrittenIsNamedWithTheReason) {
  EXPECT_EQ(failure_message([&] { write_file_whole(folder_, ""); }),
            folder_.string() + ": cannot be written: it is a folder; give a file name");
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(failure_message([&] { write_file_whole(pipe, ""); }),
            pipe.string() + ": cannot be written: it is not a plain file");

  write_file_whole(folder_ / "file", "");
  const fs::path below = folder_ / "file" / "log.csv";
  EXPECT_EQ(failure_message([&] { write_file_whole(below, ""); }),
            below.string() + ": cannot create its folder: Not a directory");
}

TEST_F(OutputFolder, IfOneNameCannotBeGivenTheOthersAreTakenBack) {
  write_file_whole(folder_ / "older.csv", "old");
  const fs::path blocked = folder_ / "blocked.csv";
  OutputFiles out;
  out.add(folder_ / "older.csv", "new");
  out.add(folder_ / "fresh.csv", "new");
  out.add(blocked, "new");
  fs::create_directories(blocked);
  const std::string message = failure_message([&] { out.commit(); });
  EXPECT_EQ(message, blocked.string() + ": not written: Is a directory");
  EXPECT_EQ(content(folder_ / "older.csv"), "old");
  EXPECT_FALSE(fs::exists(folder_ / "fresh.csv"));
  EXPECT_TRUE(fs::is_directory(blocked));
}

TEST_F(OutputFolder, AFullDiskLeavesEverythingAsItWas) {
  write_file_whole(folder_ / "a.csv", "old");
  rlimit usual;
  ::getrlimit(RLIMIT_FSIZE, &usual);
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = usual;
  small.rlim_cur = 1000;
  ::setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = failure_message([&] {
    OutputFiles out;
    out.add(folder_ / "a.csv", "new");
    out.add(folder_ / "b.csv", std::string(2000, 'x'));
    out.commit();
  });
  ::setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, before);
  EXPECT_EQ(message, (folder_ / "b.csv").string() + ": not written: File too large");
  EXPECT_EQ(content(folder_ / "a.csv"), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFolder, LeftoversOfKilledProcessesGoAndThoseOfRunningOnesStay) {
  OutputFiles running;
  running.add(folder_ / "log.csv", "");
  const fs::path of_this = fs::directory_iterator(folder_)->path();
  // A name of no process, and one of a machine whose processes are not known here.
  for (const char* name : {"log.csv.part-of-a-name", "log.csv.part-elsewhere-4026531836-4194305-0"})
    write_file_whole(folder_ / name, "");
  testing_program::kill_while_writing(folder_ / "truth.csv");
  EXPECT_EQ(files(), 4u);
  remove_leftovers(folder_);
  EXPECT_EQ(files(), 3u);
  EXPECT_TRUE(fs::exists(of_this));
}

TEST_F(OutputFolder, LeftoversGoFromEachFolderThatIsWritten) {
  testing_program::kill_while_writing(folder_ / "a" / "log.csv");
  testing_program::kill_while_writing(folder_ / "b" / "log.csv");
  OutputFiles out;
  out.add(folder_ / "a" / "report.html", "");
  out.add(folder_ / "b" / "report.html", "");
  out.commit();
  const auto left = std::distance(fs::recursive_directory_iterator(folder_), fs::recursive_directory_iterator());
  EXPECT_EQ(left, 2 + 2) << "two folders with a file each";
}

TEST_F(OutputFolder, IsLockedForOneRunAtATime) {
  const fs::path out = folder_ / "new" / "out";
  {
    const FolderLock lock(out);
    EXPECT_EQ(
        message_of([&] { FolderLock second(out); }),
        "--out '" + out.string() + "': another run writes into this folder; wait for its end, or give another folder");
    EXPECT_TRUE(fs::is_directory(out));
  }
  EXPECT_EQ(files(), 0u) << "nothing was written into the folder that the lock made";
  EXPECT_NO_THROW(FolderLock again(out));
}

TEST_F(OutputFolder, PartsShareItWithEachOtherAndNotWithARunOfAll) {
  const auto is_refused = [&](const std::string& part) {
    return message_of([&] { FolderLock lock(folder_, part); }) != "no InputError";
  };
  {
    const FolderLock part(folder_, "1_of_2"), other(folder_, "2_of_2");
    EXPECT_TRUE(is_refused("1_of_2"));
    EXPECT_TRUE(is_refused(FolderLock::kAllParts));
    EXPECT_FALSE(is_refused("")) << "submits or merges";
  }
  const FolderLock all(folder_, FolderLock::kAllParts);
  EXPECT_TRUE(is_refused("1_of_2"));
  EXPECT_FALSE(is_refused(""));
}

TEST_F(OutputFolder, IsInUseWhileARunOrOneOfItsPartsLocksIt) {
  {
    const FileLock file(folder_ / "log.csv");
    EXPECT_FALSE(is_in_use(folder_)) << "of a file";
  }
  for (const std::string part : {"", "1_of_2", FolderLock::kAllParts}) {
    const FolderLock lock(folder_, part);
    EXPECT_TRUE(is_in_use(folder_)) << part;
  }
  EXPECT_FALSE(is_in_use(folder_));
  EXPECT_FALSE(is_in_use(folder_ / "none"));
}

TEST_F(OutputFolder, LocksOfAKilledRunAreTakenOver) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const FolderLock lock(folder_);
    const FileLock lock_of_file(folder_ / "log.csv");
    [[maybe_unused]] const ssize_t written = ::write(ready[1], "x", 1);
    for (;;) ::pause();
  }
  char byte;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_NE(message_of([&] { FolderLock second(folder_); }), "no InputError");
  EXPECT_NE(message_of([&] { FileLock second(folder_ / "log.csv"); }), "no InputError");
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_NO_THROW(FolderLock second(folder_));
  EXPECT_NO_THROW(FileLock second(folder_ / "log.csv"));
  EXPECT_EQ(files(), 0u);
}

TEST_F(OutputFolder, AFileInItIsLockedForOneRunAtATime) {
  const fs::path log = folder_ / "new" / "log.csv";
  {
    const FileLock lock(log), other(folder_ / "new" / "other.csv");
    EXPECT_EQ(
        message_of([&] { FileLock second(log); }),
        "--out '" + log.string() + "': another run writes this file; wait for its end, or give another file name");
    EXPECT_NE(message_of([&] { FileLock second(folder_ / "new" / "." / "log.csv"); }), "no InputError");
  }
  EXPECT_EQ(files(), 0u) << "nothing was written into the folder that the lock made";
  EXPECT_NO_THROW(FileLock again(log));
  EXPECT_EQ(message_of([&] { FileLock lock("/proc/self/log.csv"); }),
            "--out '/proc/self/log.csv': cannot be written: No such file or directory; give another file name");
}

TEST_F(OutputFolder, AFileIsLockedUnderTheNameOfALinkToo) {
  write_file_whole(folder_ / "log.csv", "old");
  fs::create_symlink("log.csv", folder_ / "link.csv");
  const FileLock lock(folder_ / "link.csv");
  EXPECT_NE(message_of([&] { FileLock second(folder_ / "log.csv"); }), "no InputError");
}

TEST_F(OutputFolder, AnEndingProcessLeavesNothingUnfinished) {
  const pid_t child = ::fork();
  if (child == 0) {
    const FolderLock lock(folder_ / "out");
    OutputFiles out;
    out.add(folder_ / "out" / "log.csv", "text");
    remove_everything_unfinished();
    ::_exit(0);
  }
  ::waitpid(child, nullptr, 0);
  EXPECT_EQ(files(), 0u);
}

}  // namespace
}  // namespace halyard
