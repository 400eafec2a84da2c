/// The list of fields, the model file and its documentation say the same.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/small_arm.h"
#include "transmission/arm_fields.h"

namespace halyard {
namespace {

using Entries = std::vector<double>;

/// Everything that a file holds of an arm, by "2.motor.inertia"; of couplings those with inboard joints.
std::map<std::string, Entries> fields_of(const ArmParameters<double>& arm) {
  std::map<std::string, Entries> all;
  const auto add = [&](const std::string& place, const ArmField& field, const auto& value) {
    Entries& entries = all[place + std::string(field.part).append(".").append(field.name)];
    for_each_entry([&](const auto& entry) { entries.push_back(static_cast<double>(entry)); }, value);
    if (field.part == "coupling") entries.resize(std::stoul(place) - 1);
  };
  for_each_arm_field([&](const ArmField& field, const auto& value) { add("", field, value); }, arm);
  for (int k = 0; k < arm.n; ++k) {
    const auto visit = [&](const ArmField& field, const auto& value) {
      if (field.exists_at(arm.joint[k].drive)) add(std::to_string(k + 1) + ".", field, value);
    };
    for_each_joint_field(visit, arm.joint[k]);
  }
  return all;
}

TEST(ModelFields, EachIsWrittenAndReadBack) {
  ArmModel given = parse_model(kArm, "arm.xml");
  std::fill_n(given.nominal.joint[1].inertia, 3, 1e-3);  // none to change otherwise
  std::set<std::string> tried;
  for (int k = 0; k < given.n(); ++k) {
    ArmModel model = given;
    const auto try_field = [&](const ArmField& field, auto& value) {
      if (!field.exists_at(given.nominal.joint[k].drive) || field.name == "type" || field.name == "drive") return;
      model = given;
      const double by = field.part == "link" && field.name == "inertia" ? 0 : 1e-7;  // a body has not any inertia
      const auto change = [&](auto& entry) {
        using Entry = std::remove_reference_t<decltype(entry)>;
        if constexpr (std::is_same_v<Entry, double>) entry = entry * (1 + 1e-6) + by;
        else if constexpr (std::is_same_v<Entry, CableLaw>) entry = CableLaw::linear;
        else if constexpr (std::is_same_v<Entry, TorqueSource>) entry = TorqueSource::measured;
      };
      for_each_entry(change, value);
      if (field.name == "matrix") {  // only a rotation is read back as it is
        double* const R = &model.nominal.joint[k].frame_R[0][0];
        std::ranges::copy(std::array{0, 0, 1, 1, 0, 0, 0, 1, 0}, R);
      }
      const std::string name = std::to_string(k + 1).append(".").append(field.part).append(".").append(field.name);
      const ArmModel again = parse_model(model_to_xml(model), "again.xml");
      const auto expected = fields_of(model.nominal);
      EXPECT_EQ(fields_of(again.nominal), expected) << name;
      const bool changes = !std::is_same_v<decltype(value), bool&> && !(field.part == "coupling" && k == 0);
      if (changes) {
        EXPECT_NE(expected.at(name), fields_of(given.nominal).at(name)) << name;
      }
      tried.insert(name);
    };
    for_each_joint_field(try_field, model.nominal.joint[k]);
  }
  EXPECT_TRUE(tried.contains("1.cable.law") && tried.contains("2.cable.pulley_radius") && tried.contains("3.link.com"));
}

TEST(ModelFields, OfTheArmAreWrittenAndReadBack) {
  ArmModel model = parse_model(kArm, "arm.xml");
  double next = 0.5;
  const auto number = [&](const ArmField&, auto& value) {
    if constexpr (std::is_array_v<std::remove_reference_t<decltype(value)>>)
      for_each_entry([&](double& entry) { entry = next++; }, value);
  };
  for_each_arm_field(number, model.nominal);
  EXPECT_EQ(fields_of(parse_model(model_to_xml(model), "again.xml").nominal), fields_of(model.nominal));
}

/// Rows of the tables of docs/model_files.md by the element in the first column: "`<motor>`" to the second column.
std::map<std::string, std::string> documented_elements(const std::string& text) {
  std::map<std::string, std::string> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| `<")) continue;
    const auto end = line.find(">`"), column = line.find('|', end);
    rows.emplace(line.substr(4, end - 4), line.substr(column + 1, line.find('|', column + 1) - column - 1));
  }
  return rows;
}

/// The names in backquotes, each with the number that follows: its default.
std::map<std::string, std::string> documented_names(const std::string& cell) {
  std::map<std::string, std::string> names;
  for (auto from = cell.find('`'); from != cell.npos;) {
    const auto to = cell.find('`', from + 1);
    const auto next = cell.find('`', to + 1);
    std::string after = cell.substr(to + 1, next == cell.npos ? cell.npos : next - to - 1);
    after = after.substr(0, after.find_first_of(",;|"));
    after.erase(0, after.find_first_not_of(' '));
    names.emplace(cell.substr(from + 1, to - from - 1), after.substr(0, after.find(' ')));
    from = next;
  }
  return names;
}

std::string documentation() {
  std::ifstream file(HALYARD_SOURCE_DIR "/docs/model_files.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ModelFields, AreThoseOfTheDocumentedElements) {
  const std::map<std::string, std::string> rows = documented_elements(documentation());
  // What an element takes instead of a field, or to say whose the field is.
  std::map<std::string, std::set<std::string>> expected = {
      {"frame", {"rpy"}}, {"coupling", {"joint"}}, {"encoders", {"motor_counts", "joint_counts"}}};
  for (const Drive drive : {Drive::cable, Drive::rigid}) {
    JointParameters<double> joint;
    const auto visit = [&](const ArmField& field, const auto& value) {
      if (field.part.empty() || !field.exists_at(drive)) return;
      const std::string part(field.part_at(drive)), name(field.name);
      expected[part].insert(name);
      ASSERT_TRUE(rows.contains(part)) << part;
      const auto names = documented_names(rows.at(part));
      ASSERT_TRUE(names.contains(name)) << part << " " << name;
      if constexpr (std::is_same_v<decltype(value), const double&>) {
        if (field.has_default && value != 0) {
          EXPECT_EQ(std::stod(names.at(name)), value) << part << " " << name;
        }
      }
    };
    for_each_joint_field(visit, joint);
  }
  for (const auto& [part, names] : expected) {
    std::set<std::string> documented;
    for (const auto& [name, after] : documented_names(rows.at(part))) documented.insert(name);
    EXPECT_EQ(documented, names) << part;
  }
}

TEST(ModelFields, ThatStudiesVaryAreTheDocumentedKeys) {
  std::set<std::string> keys;
  ArmModel model = parse_model(kArm, "arm.xml");
  for (const ParameterInfo& info : named_parameters(model.nominal)) {
    const std::string key = info.key.substr(info.key.find('.') + 1);
    keys.insert(key.starts_with("coupling.") ? "coupling.jointJ" : key);
  }
  const std::string text = documentation();
  const auto from = text.find("`link.mass`");
  ASSERT_NE(from, text.npos);
  std::set<std::string> documented;
  for (const auto& [name, after] : documented_names(text.substr(from, text.find(". A sweep also", from) - from)))
    documented.insert(name);
  EXPECT_EQ(documented, keys);
}

}  // namespace
}  // namespace halyard
