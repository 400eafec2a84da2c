#pragma once
/// Effects from shared modules; plugins/effect_plugin.hpp says what a module exports.

#include <filesystem>
#include <vector>

#include "transmission/effect.h"

namespace halyard {

/// Adds the effects of a module to the library, all of them or none. The module stays open until the process ends.
/// No other thread may read the library meanwhile.
/// Throws InputError `plugin PATH: what; remedy` for a file that is no module (shared_module.h); a module without the
/// exported function, built for another interface version, by another compiler or with another layout of types; and
/// effects that cannot be used: a name that is taken or not valid, too many parameters or states.
void load_effects(const std::filesystem::path& path);

/// Absolute paths of the modules that load_effects() has loaded, in the order of loading.
std::vector<std::filesystem::path> loaded_effect_modules();

/// Whether the effect comes from a module that load_effects() has loaded.
bool is_from_module(const Effect& effect);

}  // namespace halyard
