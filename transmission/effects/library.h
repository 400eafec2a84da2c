#pragma once
/// The effects that come with halyard; each is one file in a folder beside this one.

#include <memory>
#include <vector>

#include "transmission/effect.h"

namespace halyard {

/// In a fixed order.
std::vector<std::unique_ptr<const Effect>> built_in_effects();

}  // namespace halyard
