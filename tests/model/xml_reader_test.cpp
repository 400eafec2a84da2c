#include "model/xml/xml_reader.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <vector>

#include "tests/support/small_arm.h"
#include "tests/support/temporary_folder.h"

namespace halyard {
namespace {

TEST(XmlElement, TypedAttributesOfOtherFilesAreReadTheSameWay) {
  const XmlElement root = XmlElement::parse(
      "<sweep jobs=\"4\" resume=\"true\">"
      "<at>1 2.5 3</at><run f=\"0.3 0.4\"/><run f=\"5\"/></sweep>",
      "folder/sweep.xml", "sweep");
  EXPECT_NO_THROW(root.only({"jobs", "resume"}, {"at", "run"}));
  EXPECT_EQ(root.integer("jobs", 1, 8), 4);
  EXPECT_EQ(root.integer_or("shard", 7, 1, 8), 7);
  EXPECT_TRUE(root.flag_or("resume", false));
  EXPECT_FALSE(root.flag_or("verbose", false));
  EXPECT_EQ(root.child("at").text_numbers(""), (std::vector<double>{1, 2.5, 3}));
  ASSERT_EQ(root.children("run").size(), 2u);
  EXPECT_EQ(root.children("run")[0].numbers("f", ""), (std::vector<double>{0.3, 0.4}));
  EXPECT_FALSE(root.optional_child("absent").has_value());
  EXPECT_EQ(message_of([&] { root.integer("jobs", 1, 3); }),
            "folder/sweep.xml:1: <sweep jobs=\"4\">: expected a whole number from 1 to 3");
  EXPECT_EQ(message_of([&] { root.child("run"); }),
            "folder/sweep.xml:1: <run>: stands twice inside <sweep>; give it once");
  EXPECT_EQ(message_of([&] { root.flag_or("jobs", true); }),
            "folder/sweep.xml:1: <sweep jobs=\"4\">: expected one of true, false");
}

TEST(XmlElement, AFileThatCannotBeReadOrHeldIsNoShorterFile) {
  // Linux answers a read of the memory at address 0 by EIO, as a bad disk does.
  EXPECT_EQ(message_of([] { XmlElement::read_file("/proc/self/mem"); }),
            "/proc/self/mem: cannot be read; check its permissions and its disk");
  const TemporaryFolder folder;
  const std::filesystem::path huge = folder / "huge.xml";
  std::ofstream(huge) << "<arm>";
  std::filesystem::resize_file(huge, std::uintmax_t(1) << 43);  // 8 TB, none of them on the disk
  const std::string message = message_of([&] { XmlElement::read_file(huge); });
  EXPECT_TRUE(message.starts_with(huge.string() + ": needs about 9.68e+04 GB of memory")) << message;
}

TEST(XmlElement, PathIsRelativeToTheFileAndOfAFileThatIsThere) {
  const std::string source = (kExamples / "sweep.xml").string();
  const auto path = [&](const std::string& model) {
    return XmlElement::parse("<sweep model=\"" + model + "\"/>", source, "sweep").path("model");
  };
  EXPECT_EQ(path("../raven2/raven2.xml"), kExamples / "../raven2/raven2.xml");
  const std::string message = message_of([&] { path("absent.xml"); });
  EXPECT_TRUE(message.starts_with(source + ":1: <sweep model=\"absent.xml\">: ")) << message;
  EXPECT_TRUE(message.ends_with("no such file; correct the path, which is relative to this file's folder")) << message;
}

TEST(XmlElement, TextHasNoControlCharacters) {
  const XmlElement root = XmlElement::parse("<a b=\"x&#27;[31m\"/>", "a.xml", "a");
  EXPECT_EQ(message_of([&] { root.text("b"); }),
            "a.xml:1: <a b=\"x?[31m\">: expected a text without control characters; remove them");
}

TEST(XmlElement, OutlivesTheDocumentItCameFrom) {
  const XmlElement child = XmlElement::parse("<a><b x=\"1\"/></a>", "a.xml", "a").child("b");
  EXPECT_EQ(child.number("x", "m"), 1);
}

}  // namespace
}  // namespace halyard
