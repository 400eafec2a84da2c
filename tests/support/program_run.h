#pragma once
/// Runs the built program the way a user's shell does, and a folder of its own for every test.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace halyard::testing_program {

namespace fs = std::filesystem;

inline std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_text(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return at == text.npos ? text : text.replace(at, from.size(), to);
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

struct RunResult {
  int exit_code = -1;  ///< 128 + signal if one ended the program
  std::string out, err;
};

/// A table of a CSV file, comment lines left out; numbers by column name.
class CsvFile {
 public:
  explicit CsvFile(const fs::path& path) {
    std::vector<std::string> names;
    for (const std::string& line : lines_of(text_of(path))) {
      if (line.starts_with('#')) continue;
      std::vector<std::string> cells;
      std::istringstream stream(line + ",");
      for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
      if (header.empty()) {
        header = cells;
      } else {
        rows.push_back(cells);
      }
    }
  }

  std::size_t index(const std::string& name) const {
    const auto found = std::ranges::find(header, name);
    EXPECT_NE(found, header.end()) << name;
    return found == header.end() ? 0 : std::size_t(found - header.begin());
  }
  double number(std::size_t row, const std::string& name) const { return std::stod(rows.at(row).at(index(name))); }
  std::vector<double> column(const std::string& name) const {
    const std::size_t at = index(name);
    std::vector<double> values;
    for (const auto& row : rows) values.push_back(std::stod(row.at(at)));
    return values;
  }
  /// The row whose named cells have these texts.
  std::size_t row_with(const std::map<std::string, std::string>& cells) const {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (std::ranges::all_of(cells, [&](const auto& cell) { return rows[i].at(index(cell.first)) == cell.second; })) {
        return i;
      }
    }
    ADD_FAILURE() << "no such row";
    return 0;
  }

  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// All files of a folder, by path relative to it.
inline std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = text_of(entry.path());
  }
  return files;
}

class ProgramTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) /
              (std::string(test->test_suite_name()) + "-" + test->name() + "-" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path path(const std::string& name) const { return folder_ / name; }

  /// Runs in the test's folder, where relative paths then count from. `first`: shell commands that the program's shell
  /// runs before, such as "ulimit -f 8;".
  RunResult run(const std::vector<std::string>& arguments, const std::string& first = "") const {
    // Outside the folder, so that tests see there what the program left and nothing else.
    const fs::path out = folder_.string() + ".out", err = folder_.string() + ".err";
    std::string command = "cd";
    const auto append = [&command](const std::string& text) {
      command += " '";
      for (const char c : text) command += c == '\'' ? std::string("'\\''") : std::string(1, c);
      command += "'";
    };
    append(folder_.string());
    command += " && " + first + " exec";
    append(program_.string());
    for (const std::string& argument : arguments) append(argument);
    command += " >";
    append(out.string());
    command += " 2>";
    append(err.string());
    const int status = std::system(command.c_str());
    const RunResult result{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text_of(out),
                           text_of(err)};
    fs::remove(out);
    fs::remove(err);
    return result;
  }

  /// The same for a run that must succeed, with nothing on stderr; returns what it printed.
  std::string done(const std::vector<std::string>& arguments) const {
    const RunResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return result.out;
  }

  static std::string example(const std::string& name) {
    return (fs::path(HALYARD_SOURCE_DIR) / "examples/raven2" / name).string();
  }

  /// A short version of a scenario of the examples, in the test's folder under its own name.
  void write_short_scenario(const std::string& name, const std::string& duration = "1") const {
    std::string text = text_of(example(name));
    text = replaced(text, "duration=\"20\"", "duration=\"" + duration + "\"");
    write_text(path(name), text);
    for (const char* model : {"raven2.xml", "raven2_exponential.xml"}) {
      if (!fs::exists(path(model))) fs::copy(example(model), path(model));
    }
  }

  fs::path folder_;
  fs::path program_ = HALYARD_PROGRAM;
};

}  // namespace halyard::testing_program
