/// The grid of a sweep, and the folder that keeps its results.

#include "evaluation/sweep/sweep_store.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "evaluation/sweep/sweep_cells.h"
#include "tests/support/message_of.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

template <class Add>
void store(const Add& add) {
  OutputFiles files;
  add(files);
  files.commit();
}

SweepGrid grid_of_six() {
  SweepGrid grid;
  grid.name = "stiffness and \"tension\"";
  grid.id = "12ab";
  grid.scenario = "a.xml";
  grid.model = "arm.xml";
  grid.skip_s = 0.25;
  grid.estimators = {"kinematics", "./mine.so"};
  grid.measures = parse_measures("nees,time,errors");
  grid.units = {{"rad", "deg", 57.29577951308232}, {"m", "mm", 1000}};
  grid.axes.resize(2);
  grid.axes[0].parameters = {"joint1.cable.stiffness"};
  grid.axes[0].applies_to = SweepAxis::Target::robot;
  grid.axes[0].unit = "N/m";
  grid.axes[0].values = {1e5, 2e5};
  grid.axes[1].parameters = {"joint1.cable.tension", "joint2.cable.tension"};
  grid.axes[1].is_factor = grid.axes[1].is_logarithmic = true;
  grid.axes[1].values = {0.5, 1.0 / 3, 2};
  return grid;
}

/// An empty folder that goes with the test.
class SweepStore : public testing::Test {
 protected:
  SweepStore() { fs::remove_all(folder), fs::create_directories(folder / "cells"); }
  ~SweepStore() override { fs::remove_all(folder); }
  void write(const fs::path& path, const std::string& text) const { std::ofstream(path) << text; }

  const fs::path folder = fs::path(testing::TempDir()) /
                          ("store_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
  const SweepGrid grid = grid_of_six();
};

TEST(SweepGrid, HasEachCombinationOnceAndVariesTheLastAxisFastest) {
  const SweepGrid grid = grid_of_six();
  ASSERT_EQ(grid.size(), 6u);
  std::set<std::vector<double>> met;
  for (std::size_t p = 0; p < grid.size(); ++p) {
    const std::vector<std::size_t> places = grid.places(p);
    EXPECT_EQ(places[0] * 3 + places[1], p);
    EXPECT_EQ(grid.values(p), (std::vector<double>{grid.axes[0].values[places[0]], grid.axes[1].values[places[1]]}));
    met.insert(grid.values(p));
  }
  EXPECT_EQ(met.size(), 6u);
}

TEST(SweepGrid, HasEachCombinationOnceForEachSeed) {
  SweepGrid grid = grid_of_six();
  grid.seeds = {7, 9};
  EXPECT_EQ(grid.size(), 12u);
  EXPECT_EQ(grid.values(4), grid.values(5));
  EXPECT_EQ(grid.values(4), grid_of_six().values(2));
  EXPECT_EQ(grid.seed(4), 7u);
  EXPECT_EQ(grid.seed(5), 9u);
  EXPECT_EQ(grid_of_six().seed(4), std::nullopt);
}

TEST(SweepGrid, OfSamplesHasTheValuesOfEachAxisTogether) {
  SweepGrid grid = grid_of_six();
  grid.is_sampled = true;
  grid.axes[0].values = {1, 2, 3};
  EXPECT_EQ(grid.size(), 3u);
  EXPECT_EQ(grid.values(1), (std::vector<double>{2, 1.0 / 3}));
}

TEST(SweepGrid, DescribesAPoint) {
  const SweepGrid grid = grid_of_six();
  EXPECT_EQ(grid.axes[1].label(), "joint1.cable.tension and 1 more (factor)");
  EXPECT_EQ(grid.description(5), "joint1.cable.stiffness = 200000 N/m, joint1.cable.tension and 1 more (factor) = 2");
  EXPECT_EQ(grid.description(0, 1), "joint1.cable.tension and 1 more (factor) = 0.5");
}

TEST_F(SweepStore, GivesTheGridBack) {
  store([&](auto& files) { write_grid(files, folder, grid); });
  const SweepGrid read = read_grid(folder);
  EXPECT_EQ(read.name, grid.name);
  EXPECT_EQ(read.id, grid.id);
  EXPECT_EQ(read.scenario, grid.scenario);
  EXPECT_EQ(read.model, grid.model);
  EXPECT_EQ(read.skip_s, grid.skip_s);
  EXPECT_EQ(read.estimators, grid.estimators);
  EXPECT_EQ(read.measures, grid.measures);
  ASSERT_EQ(read.axes.size(), grid.axes.size());
  for (std::size_t i = 0; i < grid.axes.size(); ++i) {
    EXPECT_EQ(read.axes[i].parameters, grid.axes[i].parameters);
    EXPECT_EQ(read.axes[i].applies_to, grid.axes[i].applies_to);
    EXPECT_EQ(read.axes[i].is_factor, grid.axes[i].is_factor);
    EXPECT_EQ(read.axes[i].is_logarithmic, grid.axes[i].is_logarithmic);
    EXPECT_EQ(read.axes[i].unit, grid.axes[i].unit);
    EXPECT_EQ(read.axes[i].values, grid.axes[i].values);  // to the last bit
  }
  ASSERT_EQ(read.units.size(), 2u);
  EXPECT_EQ(read.units[1].shown, "mm");
  EXPECT_EQ(read.units[0].shown_per_si, grid.units[0].shown_per_si);
}

TEST_F(SweepStore, GivesTheGridOfLimitsBack) {
  SweepGrid limits = grid;
  limits.estimators = {};
  limits.measures = {&limits_measure()};
  limits.effects = {{"backlash", "half_gap", {"m", ""}}};
  store([&](auto& files) { write_grid(files, folder, limits); });
  const SweepGrid read = read_grid(folder);
  EXPECT_EQ(read.subjects(), std::vector<std::string>{"backlash"});
  EXPECT_EQ(read.effects[0].parameter, "half_gap");
  EXPECT_EQ(read.effects[0].units, limits.effects[0].units);
  EXPECT_EQ(read.measures, limits.measures);
}

TEST_F(SweepStore, ReadsAGridThatSaysNotWhatItMeasures) {
  store([&](auto& files) { write_grid(files, folder, grid); });
  std::ifstream file(folder / "sweep.json");
  nlohmann::json json = nlohmann::json::parse(file);
  json.erase("measures"), json.erase("effects");
  write(folder / "sweep.json", json.dump());
  const SweepGrid read = read_grid(folder);
  EXPECT_EQ(read.measures, parse_measures("errors"));
  EXPECT_FALSE(read.measures_limits());
}

TEST_F(SweepStore, RefusesWhatIsDamaged) {
  EXPECT_EQ(message_of([&] { read_grid(folder); }),
            folder.string() + ": holds no sweep.json; give a folder that halyard sweep wrote");
  const auto damaged = [](const fs::path& path) {
    return path.string() + ": is no result of halyard sweep or is damaged; remove it and run the sweep again";
  };
  write(folder / "sweep.json", "{\"sweep\": ");
  EXPECT_EQ(message_of([&] { read_grid(folder); }), damaged(folder / "sweep.json"));
}

TEST_F(SweepStore, RefusesAGridThatContradictsItself) {
  store([&](auto& files) { write_grid(files, folder, grid); });
  std::ifstream file(folder / "sweep.json");
  const nlohmann::json right = nlohmann::json::parse(file);
  const auto refuses = [&](const std::string& place, const nlohmann::json& value) {
    nlohmann::json wrong = right;
    wrong[nlohmann::json::json_pointer(place)] = value;
    write(folder / "sweep.json", wrong.dump());
    return message_of([&] { read_grid(folder); }).ends_with("is damaged; remove it and run the sweep again");
  };
  EXPECT_FALSE(refuses("/name", "another"));
  EXPECT_TRUE(refuses("/axes/0/applies_to", "nothing"));
  EXPECT_TRUE(refuses("/axes/0/parameters", nlohmann::json::array()));
  EXPECT_TRUE(refuses("/axes/1/values", nlohmann::json::array()));
  EXPECT_TRUE(refuses("/measures", nlohmann::json::array({"beauty"})));
  EXPECT_TRUE(refuses("/sampled", true));  // the axes have two and three values
  EXPECT_TRUE(refuses("/points", 7));
  EXPECT_TRUE(refuses("/points", 2.2e110)) << "no integer holds it";
  EXPECT_TRUE(refuses("/seeds", {1.5}));
  EXPECT_TRUE(refuses("/axes", nlohmann::json::array()));
  EXPECT_TRUE(refuses("/seeds", std::vector<int>(1000001, 1)));  // more points than a sweep can have
}

TEST_F(SweepStore, RefusesMoreSamplesThanASweepCanHave) {
  store([&](auto& files) { write_grid(files, folder, grid); });
  std::ifstream file(folder / "sweep.json");
  nlohmann::json wrong = nlohmann::json::parse(file);
  wrong["sampled"] = true;
  constexpr int kSamples = 2000, kSeeds = 1000;  // either number alone is allowed
  for (nlohmann::json& axis : wrong["axes"]) axis["values"] = std::vector<double>(kSamples, 1);
  wrong["seeds"] = std::vector<int>(kSeeds, 1);
  wrong["points"] = kSamples * kSeeds;
  write(folder / "sweep.json", wrong.dump());
  EXPECT_TRUE(message_of([&] { read_grid(folder); }).ends_with("is damaged; remove it and run the sweep again"));
}

TEST_F(SweepStore, RefusesAFolderWithAnotherSweepAndLeavesItAsItIs) {
  store_grid(folder, grid);
  EXPECT_NO_THROW(store_grid(folder, grid));
  SweepGrid other = grid;
  other.id = "34cd";
  EXPECT_EQ(message_of([&] { store_grid(folder, other); }),
            folder.string() +
                ": holds results of another sweep, or of this one before its files were changed; remove it, or give "
                "another folder");
  EXPECT_EQ(read_grid(folder).id, grid.id);
}

}  // namespace
}  // namespace halyard
