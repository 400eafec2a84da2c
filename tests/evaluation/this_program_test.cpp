/// How results say which program computed them.

#include "evaluation/this_program.h"

#include <gtest/gtest.h>

#include <regex>

#include "halyard/version.h"

namespace halyard {
namespace {

TEST(ThisProgram, SaysVersionBuildAndInstructionSet) {
  const std::regex form("halyard " + std::string(kVersion) + ", build [0-9a-f]{8}, (generic|avx2|avx512)");
  EXPECT_TRUE(std::regex_match(this_program(), form)) << this_program();
}

}  // namespace
}  // namespace halyard
