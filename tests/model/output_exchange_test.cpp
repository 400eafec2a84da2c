/// Outputs on a file system that cannot exchange two names, as many network file systems.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "model/output/output_files.h"

namespace {

std::atomic<bool> cannot_exchange{false};

}  // namespace

/// In place of the C library's.
extern "C" int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept {
  if (cannot_exchange && flags == RENAME_EXCHANGE) return errno = EINVAL, -1;
  return static_cast<int>(::syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
}

namespace halyard {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(OutputFilesWithoutExchange, KeepAFileThatReplacedAnOlderOneAndTakeBackTheOthers) {
  const fs::path folder = fs::path(testing::TempDir()) / ("without-exchange-" + std::to_string(::getpid()));
  fs::create_directories(folder / "taken");
  write_file_whole(folder / "old.csv", "old");
  cannot_exchange = true;
  {
    OutputFiles out;
    out.add(folder / "old.csv", "new");
    out.add(folder / "new.csv", "new");
    out.add(folder / "name", "text");
    fs::rename(folder / "taken", folder / "name");  // its name cannot be given any more
    EXPECT_THROW(out.commit(), std::runtime_error);
  }
  cannot_exchange = false;
  EXPECT_EQ(content(folder / "old.csv"), "new");
  EXPECT_FALSE(fs::exists(folder / "new.csv"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 2);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace halyard
