/// The journal of a sweep on a disk that fails now and then.

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>

#include "evaluation/sweep/sweep_cells.h"

namespace {

/// Calls of fdatasync() from now on that fail: a disk tells of an error once, and only to the file that asks first.
std::atomic<int> failing_syncs = 0;

}  // namespace

/// Takes the place of the C library's in this program.
extern "C" int fdatasync(int file) {
  if (failing_syncs > 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));  // others write and wait meanwhile
    --failing_syncs;
    errno = EIO;
    return -1;
  }
  using Function = int (*)(int);
  static const auto real = reinterpret_cast<Function>(::dlsym(RTLD_NEXT, "fdatasync"));
  return real(file);
}

namespace halyard {
namespace {

namespace fs = std::filesystem;

class FaultyDisk : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    grid_.id = "12ab";
    grid_.axes = {{.parameters = {"joint1.cable.stiffness"}, .unit = "N/m", .values = {1, 2, 3, 4}}};
    grid_.estimators = {"kinematics"};
    grid_.units = {{"rad", "deg", 57}};
  }
  void TearDown() override {
    failing_syncs = 0;
    fs::remove_all(folder_);
  }

  static std::string failure_of(CellJournal& journal, std::size_t point) {
    try {
      journal.add(cell_at(point));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  static SweepCell cell_at(std::size_t point) { return {point, {{"", {{1, 2, 3, 4, 5, 6}}}}}; }

  const fs::path folder_ =
      fs::path(testing::TempDir()) / ("halyard_faulty_disk_" + std::to_string(static_cast<long>(::getpid())));
  SweepGrid grid_;
};

TEST_F(FaultyDisk, AFailedSyncFailsEveryPointThatWaitedForIt) {
  CellJournal journal(folder_, grid_, {});
  journal.add(cell_at(0));
  failing_syncs = 1;
  std::string of_first, of_second;
  {
    const std::jthread first([&] { of_first = failure_of(journal, 1); });
    const std::jthread second([&] { of_second = failure_of(journal, 2); });
  }
  const std::string expected = ": not written: Input/output error; the points before are kept";
  EXPECT_NE(of_first.find(expected), std::string::npos) << of_first;
  EXPECT_NE(of_second.find(expected), std::string::npos) << of_second;
  const StoredCells stored({folder_}, grid_);
  EXPECT_EQ(stored.count(), 1u);
  EXPECT_TRUE(stored.has(0));
}

TEST_F(FaultyDisk, AJournalThatCannotBeReadIsNotWritten) {
  const fs::path path = journal_path(folder_, {});
  fs::create_directories(path.parent_path());
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);  // can be opened, and not be read at a place
  CellJournal journal(folder_, grid_, {});
  for (int i = 0; i < 2; ++i) {
    const std::string message = failure_of(journal, 0);
    EXPECT_NE(message.find(": cannot be read: "), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace halyard
