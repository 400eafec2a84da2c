#pragma once
/// The effects that come with halyard; each is one file in a subfolder of this folder.

#include <memory>
#include <vector>

#include "transmission/effect.h"

namespace halyard {

/// New instances of all built-in effects, in a fixed order.
std::vector<std::unique_ptr<const Effect>> built_in_effects();

}  // namespace halyard
