/// Tables as they are written for other programs.

#include "evaluation/csv.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace halyard {
namespace {

TEST(CsvTable, EndsARowWhenItIsAsLongAsTheHeader) {
  CsvTable table({"a", "b"}, "what it is\nand of when");
  table.add(1.5);
  table.add("x");
  table.add(-2.0);
  table.add("y");
  EXPECT_EQ(table.text(), "# what it is\n# and of when\na,b\n1.5,x\n-2,y\n");
}

TEST(CsvTable, WritesNineDigitsAndLeavesNaNEmpty) {
  CsvTable table({"a", "b", "c"});
  table.add(1.0 / 3);
  table.add(std::numeric_limits<double>::quiet_NaN());
  table.add(6.02214076e23);
  EXPECT_EQ(table.text(), "a,b,c\n0.333333333,,6.02214076e+23\n");
}

TEST(CsvTable, KeepsMicrosecondsOfAnyClock) {
  CsvTable table({"t"});
  table.add_time(86399.123456);
  table.add_time(1700000000.123456);
  EXPECT_EQ(table.text(), "t\n86399.123456\n1700000000.123456\n");
}

TEST(CsvTable, QuotesWhatWouldBreakARow) {
  CsvTable table({"a"});
  table.add("one, two");
  table.add("a \"word\"");
  table.add("two\nlines");
  table.add("plain; text");
  EXPECT_EQ(table.text(), "a\n\"one, two\"\n\"a \"\"word\"\"\"\n\"two\nlines\"\nplain; text\n");
}

TEST(CsvTable, DoesNotGiveOutHalfARow) {
  CsvTable table({"a", "b"});
  table.add(1.0);
  EXPECT_THROW(table.text(), std::logic_error);
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "half_a_row.csv";
  EXPECT_THROW(table.write(path), std::logic_error);
  EXPECT_FALSE(std::filesystem::exists(path));
  table.add(2.0);
  table.write(path);
  std::stringstream written;
  written << std::ifstream(path).rdbuf();
  EXPECT_EQ(written.str(), table.text());
}

}  // namespace
}  // namespace halyard
