/// Which instruction sets are used, and the copies of code for them.

#include "transmission/lanes/instruction_set.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace halyard {
namespace {

/// Of this processor, those of this build that the user allows, the widest first.
std::vector<InstructionSet> sets_of_this_processor() {
  std::vector<InstructionSet> sets;
#if defined(HALYARD_WIDE_LANES)
  const char* name = std::getenv("HALYARD_INSTRUCTION_SET");
  const std::string widest = name ? name : "avx512";
  const bool has_fma = __builtin_cpu_supports("fma");
  const bool has_avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
  if (has_fma && has_avx512 && widest != "avx2" && widest != "generic") sets.push_back(InstructionSet::avx512);
  if (has_fma && __builtin_cpu_supports("avx2") && widest != "generic") sets.push_back(InstructionSet::avx2);
#endif
  sets.push_back(InstructionSet::generic);
  return sets;
}

TEST(InstructionSets, AreThoseOfTheProcessorThatTheUserAllowsTheWidestFirst) {
  EXPECT_EQ(instruction_sets(), sets_of_this_processor());
}

TEST(InstructionSets, EachHasTheCopyOfItsOwn) {
  const int generic = 1, avx2 = 2, avx512 = 3;
  std::vector<int> expected;
  for (const InstructionSet set : instruction_sets())
    expected.push_back(set == InstructionSet::avx512 ? avx512 : set == InstructionSet::avx2 ? avx2 : generic);
  EXPECT_EQ(usable_copies<int>({&generic, &avx2, &avx512}), expected);
}

}  // namespace
}  // namespace halyard
