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

}  // namespace halyard
