// The program takes no library from the folder that it is run in.
#include <gtest/gtest.h>

#include <set>

#include "tests/support/elf_file.h"
#include "tests/support/program_run.h"

namespace halyard::testing_program {
namespace {

class PlantedLibrary : public ProgramTest {
 protected:
  /// The names of all libraries that the program and its own libraries ask the loader for.
  std::set<std::string> needed_libraries() const {
    std::vector<fs::path> files = {program_};
    for (const auto& entry : fs::directory_iterator(program_.parent_path() / "lib"))
      if (entry.is_regular_file() && is_elf_file(entry.path())) files.push_back(entry.path());
    std::set<std::string> names;
    for (const fs::path& file : files)
      for (const std::string& name : dynamic_section_of(file).needed) names.insert(name);
    return names;
  }
};

TEST_F(PlantedLibrary, IsNotLoaded) {
  write_short_scenario("experiment_a.xml", "0.1");
  const std::set<std::string> names = needed_libraries();
  ASSERT_TRUE(names.contains("libtbb.so.12"));
  for (const std::string& name : names) fs::copy(HALYARD_PLANTED_LIBRARY, path(name));

  EXPECT_EQ(run({"--version"}).exit_code, 0);
  // Estimators are run in processes of their own.
  const RunResult compared = run({"compare", "experiment_a.xml", "--model", "raven2.xml", "--estimators", "kinematics",
                                  "--skip", "0", "--out", "out"});
  EXPECT_EQ(compared.exit_code, 0) << compared.err;
  EXPECT_FALSE(fs::exists(path("planted_library_was_loaded")));
}

}  // namespace
}  // namespace halyard::testing_program
