#include "model/machine/memory_limit.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

void put(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text << "\n";
}

TEST(MemoryLimit, IsTheLeastOfTheControlGroupAndThoseItIsIn) {
  const TemporaryFolder root;
  put(root / "proc/self/cgroup", "0::/slurm/job_7/step_0");
  put(root / "sys/fs/cgroup/slurm/memory.max", "max");
  put(root / "sys/fs/cgroup/slurm/job_7/memory.max", "1000000");
  put(root / "sys/fs/cgroup/slurm/job_7/step_0/memory.max", "2000000");
  EXPECT_EQ(memory_limit_bytes(root), 1e6);
}

TEST(MemoryLimit, OfAContainerStandsAtTheRootOfItsGroups) {
  const TemporaryFolder root;
  put(root / "proc/self/cgroup", "0::/");
  put(root / "sys/fs/cgroup/memory.max", "3000000");
  EXPECT_EQ(memory_limit_bytes(root), 3e6);
}

TEST(MemoryLimit, IsReadFromGroupsOfVersionOneToo) {
  const TemporaryFolder root;
  put(root / "proc/self/cgroup", "7:cpu,cpuacct:/jobs\n5:memory:/jobs/job_7");
  put(root / "sys/fs/cgroup/memory/jobs/job_7/memory.limit_in_bytes", "4000000");
  EXPECT_EQ(memory_limit_bytes(root), 4e6);
}

TEST(MemoryLimit, WithoutControlGroupsIsThatOfTheMachine) {
  const TemporaryFolder root;
  EXPECT_GT(memory_limit_bytes(root), 1e8);
}

}  // namespace
}  // namespace halyard
