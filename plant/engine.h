#pragma once

namespace halyard {

/// Who computes the rigid chain of a plant. Both give the same motion (tests compare them over random arms).
enum class Engine {
  simbody,  ///< Simbody: the reference
  halyard,  ///< model/rigid_chain.h: many times faster
};

}  // namespace halyard
