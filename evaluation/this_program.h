#pragma once

#include <string>

namespace halyard {

/// Which program computes, such as "halyard 0.1.0, build 1f2e3d4c, avx2". Programs with the same text compute the same
/// bytes from the same input. The build is a hash of the build ids that the linker has given to halyard's libraries, or
/// to the program if it contains them; it is "unknown" without such ids. The last word is the widest instruction set
/// in use (transmission/lanes/instruction_set.h).
const std::string& this_program();

}  // namespace halyard
