#pragma once
/// Eigen gets memory in another way where -march gives wider vectors, so that what one side allocates the other cannot
/// free. A module and the halyard libraries that it is linked to need the same.

namespace halyard {

/// own: EIGEN_DEFAULT_ALIGN_BYTES where this is called. Throws InputError if halyard's libraries have another.
void check_eigen_alignment(int own);

}  // namespace halyard
