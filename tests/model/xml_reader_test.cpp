#include "model/xml/xml_reader.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/small_arm.h"

namespace halyard {
namespace {

TEST(XmlElement, TypedAttributesOfOtherFilesAreReadTheSameWay) {
  const XmlElement root = XmlElement::parse(
      "<sweep model=\"../arm.xml\" jobs=\"4\" resume=\"true\">"
      "<at>1 2.5 3</at><run f=\"0.3 0.4\"/><run f=\"5\"/></sweep>",
      "folder/sweep.xml", "sweep");
  EXPECT_NO_THROW(root.only({"model", "jobs", "resume"}, {"at", "run"}));
  EXPECT_EQ(root.path("model"), "folder/../arm.xml");
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

TEST(XmlElement, OutlivesTheDocumentItCameFrom) {
  const XmlElement child = XmlElement::parse("<a><b x=\"1\"/></a>", "a.xml", "a").child("b");
  EXPECT_EQ(child.number("x", "m"), 1);
}

}  // namespace
}  // namespace halyard
