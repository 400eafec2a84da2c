#pragma once
/// Effects from shared modules; plugins/effect_plugin.hpp says what a module exports.

#include <filesystem>
#include <vector>

#include "transmission/effect.h"

namespace halyard {

/// Adds the effects of a module to the library, all of them or none. The module stays open until the process ends.
/// Not for use while others read the library.
/// Throws InputError `plugin PATH: what; remedy` for a file that is no module (shared_module.h), one without the
/// exported function, one built for another interface version, by another compiler or with types laid out otherwise,
/// and for effects that cannot be used: a name that is taken or that is none, too many parameters or states.
void load_effects(const std::filesystem::path& path);

/// The modules that load_effects() has taken, in this order: absolute paths.
std::vector<std::filesystem::path> loaded_effect_modules();

/// Whether load_effects() brought the effect.
bool is_from_module(const Effect& effect);

}  // namespace halyard
