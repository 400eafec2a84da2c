#pragma once
/// Which vector instructions this processor has. Code over Lanes is compiled once for each set (files *_generic.cpp,
/// *_avx2.cpp, *_avx512.cpp); whoever calls it chooses by this list and by nothing else.

#include <vector>

namespace halyard {

/// With the compiler flags that its files have.
enum class InstructionSet {
  generic,  ///< none beside those that every processor of the kind has
  avx2,     ///< -mavx2 -mfma
  avx512    ///< -mavx512f -mavx512dq -mfma
};

/// Those that this processor can run and that halyard was compiled for, the widest first; the last is generic.
const std::vector<InstructionSet>& instruction_sets();

}  // namespace halyard
