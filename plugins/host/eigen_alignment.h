#pragma once
/// Eigen's memory allocation depends on the vector width that -march selects. Code built for one width cannot free
/// memory allocated for another. A module and the halyard libraries that it is linked to must use the same alignment.

namespace halyard {

/// own: EIGEN_DEFAULT_ALIGN_BYTES of the caller. Throws InputError if halyard's libraries have another value.
void check_eigen_alignment(int own);

}  // namespace halyard
