#include "transmission/lanes/instruction_set.h"

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace halyard {
namespace {

/// The widest set that the user allows.
InstructionSet widest_allowed() {
  const char* name = std::getenv("HALYARD_INSTRUCTION_SET");
  const std::string set = name ? name : "";
  if (set == "generic") return InstructionSet::generic;
  if (set == "avx2") return InstructionSet::avx2;
  if (set.empty() || set == "avx512") return InstructionSet::avx512;
  throw std::invalid_argument("HALYARD_INSTRUCTION_SET is \"" + set +
                              "\", expected generic, avx2 or avx512; unset it for the widest of this processor");
}

}  // namespace

const std::vector<InstructionSet>& instruction_sets() {
  static const std::vector<InstructionSet> usable = [] {
    std::vector<InstructionSet> all;
    [[maybe_unused]] const InstructionSet widest = widest_allowed();
#if defined(HALYARD_WIDE_LANES)
    // Every flag of the set's files is asked for: a processor, or a virtual machine, may have one without the other.
    const bool has_fma = __builtin_cpu_supports("fma");
    if (widest == InstructionSet::avx512 && has_fma && __builtin_cpu_supports("avx512f") &&
        __builtin_cpu_supports("avx512dq"))
      all.push_back(InstructionSet::avx512);
    if (widest != InstructionSet::generic && has_fma && __builtin_cpu_supports("avx2"))
      all.push_back(InstructionSet::avx2);
#endif
    all.push_back(InstructionSet::generic);
    return all;
  }();
  return usable;
}

}  // namespace halyard
