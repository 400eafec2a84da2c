#pragma once
/// Vector instructions of this processor. Code over Lanes is compiled once for each set (files *_generic.cpp,
/// *_avx2.cpp, *_avx512.cpp). Callers must choose a copy whose set is in instruction_sets().

#include <vector>

namespace halyard {

/// An instruction set, and the compiler flags of its files.
enum class InstructionSet {
  generic,  ///< only the instructions that every processor of this architecture has
  avx2,     ///< -mavx2 -mfma
  avx512    ///< -mavx512f -mavx512dq -mfma
};

/// The sets that this processor supports and that halyard was compiled for, the widest first; the last is generic.
const std::vector<InstructionSet>& instruction_sets();

/// A table of functions that is compiled once for each set. Builds for x86-64 have all copies, unless
/// HALYARD_WIDE_LANES is off, as in the presets for coverage and fuzzing. Others have the generic one.
template <class Kernels>
struct KernelCopies {
  const Kernels* generic;
  const Kernels* avx2 = nullptr;
  const Kernels* avx512 = nullptr;
};

/// The copies of the sets in instruction_sets(), in the same order.
template <class Kernels>
std::vector<Kernels> usable_copies(const KernelCopies<Kernels>& copies) {
  std::vector<Kernels> usable;
  for (const InstructionSet set : instruction_sets()) {
    if (set == InstructionSet::avx512) usable.push_back(*copies.avx512);
    else if (set == InstructionSet::avx2) usable.push_back(*copies.avx2);
    else usable.push_back(*copies.generic);
  }
  return usable;
}

}  // namespace halyard
