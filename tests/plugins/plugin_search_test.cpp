// Where plug-ins are looked for, and which of several of a name counts.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/plugin_fixtures.h"

namespace fs = std::filesystem;
using namespace halyard::plugin_fixtures;

namespace {

/// Sets HALYARD_PLUGIN_PATH until the end of the scope.
class PluginPath {
 public:
  explicit PluginPath(const std::string& folders) { setenv("HALYARD_PLUGIN_PATH", folders.c_str(), 1); }
  ~PluginPath() { unsetenv("HALYARD_PLUGIN_PATH"); }
};

}  // namespace

TEST(PluginSearch, FoldersOfTheUserComeLastAndTheFirstOfANameCounts) {
  const TemporaryFolder first, second;
  fs::copy_file(fixture("well_formed"), first / "fixture.so");
  fs::copy_file(fixture("well_formed"), second / "another_file.so");
  fs::copy_file(fixture("newer_interface"), second / "too_new.so");
  fs::copy_file(fixture("throws_in_update"), second / "throws_in_update.so");
  const PluginPath path((first / "").string() + ":" + (second / "").string() +
                        ":/no/such/folder:" + (first / "").string());

  std::vector<std::string> refused;
  std::vector<halyard::PluginInfo> found = halyard::find_plugins(&refused);
  ASSERT_GE(found.size(), 2u);
  EXPECT_EQ(found[found.size() - 2].name, "fixture");
  EXPECT_EQ(found[found.size() - 2].description, "joint position = motor position");
  EXPECT_EQ(found[found.size() - 2].path, fs::canonical(first / "fixture.so"));
  EXPECT_EQ(found.back().name, "throws_in_update");

  ASSERT_EQ(refused.size(), 3u);
  EXPECT_EQ(refused[0], "HALYARD_PLUGIN_PATH: '/no/such/folder' is no folder; correct it or take it out");
  EXPECT_EQ(refused[1], "plugin " + fs::canonical(second / "another_file.so").string() +
                            ": the name 'fixture' is taken by " + fs::canonical(first / "fixture.so").string() +
                            "; rename it, or call it by its path");
  EXPECT_EQ(refused[2], "plugin " + fs::canonical(second / "too_new.so").string() +
                            ": built for interface 3, this program speaks 2; install a newer halyard, or rebuild it "
                            "against these headers");
  EXPECT_NO_THROW(halyard::make_estimator("fixture", raven2()));
}

TEST(PluginSearch, AnUnknownNameListsTheKnownOnesAndSaysWhatWasRefused) {
  const TemporaryFolder folder;
  fs::copy_file(fixture("newer_interface"), folder / "wanted.so");
  const PluginPath path((folder / "").string());
  const std::string message = refusal("wanted");
  EXPECT_TRUE(message.starts_with("no estimator is named 'wanted' (plugin ")) << message;
  EXPECT_NE(message.find("built for interface 3, this program speaks 2"), std::string::npos) << message;
  EXPECT_TRUE(message.ends_with("; give one of these, or the path of a module such as ./wanted.so")) << message;
}

TEST(PluginSearch, FindsTheBuiltInEstimators) {
  std::vector<std::string> refused, names;
  for (const halyard::PluginInfo& plugin : halyard::find_plugins(&refused)) names.push_back(plugin.name);
  EXPECT_EQ(names, (std::vector<std::string>{"camera_sr_ukf", "disturbance_sr_ukf", "ekf", "kinematics", "smoother",
                                             "sr_ukf"}));
  EXPECT_EQ(refused, std::vector<std::string>());
  EXPECT_EQ(halyard::find_plugin("ekf").path.filename(), "ekf.so");
}
