#include "transmission/lanes/instruction_set.h"

namespace halyard {

const std::vector<InstructionSet>& instruction_sets() {
  static const std::vector<InstructionSet> usable = [] {
    std::vector<InstructionSet> all;
#if defined(__x86_64__)
    // Every flag of the set's files is asked for: a processor, or a virtual machine, may have one without the other.
    const bool has_fma = __builtin_cpu_supports("fma");
    if (has_fma && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
      all.push_back(InstructionSet::avx512);
    if (has_fma && __builtin_cpu_supports("avx2")) all.push_back(InstructionSet::avx2);
#endif
    all.push_back(InstructionSet::generic);
    return all;
  }();
  return usable;
}

}  // namespace halyard
