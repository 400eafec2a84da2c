#include "plugins/host/eigen_alignment.h"

#include <Eigen/Core>
#include <string>

#include "model/input_error.h"

namespace halyard {

void check_eigen_alignment(int own) {
  if (own == EIGEN_DEFAULT_ALIGN_BYTES) return;
  throw InputError("compiled for vectors of " + std::to_string(own) + " bytes, halyard's libraries for " +
                   std::to_string(EIGEN_DEFAULT_ALIGN_BYTES) +
                   "; compile the plug-in's files that include Eigen without -march or -mavx");
}

}  // namespace halyard
