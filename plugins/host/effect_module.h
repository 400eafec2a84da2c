#pragma once
/// Effects from shared modules; plugins/effect_plugin.hpp says what a module exports.

#include <filesystem>
#include <vector>

#include "transmission/effect.h"

namespace halyard {

/// Adds the effects of a module to the library, all of them or none. The module stays open until the process ends. No
/// other thread may read the library while this function runs.
/// Throws InputError `plugin PATH: what; remedy` if the file is no module (shared_module.h); if the module lacks the
/// exported function, or was built for another interface version, by another compiler or with another layout of types;
/// or if an effect cannot be used, because its name is taken or not valid, or because it has too many parameters or
/// states.
void load_effects(const std::filesystem::path& path);

/// Absolute paths of the modules that load_effects() has loaded, in the order of loading.
std::vector<std::filesystem::path> loaded_effect_modules();

/// Whether the effect comes from a module that load_effects() has loaded.
bool is_from_module(const Effect& effect);

}  // namespace halyard
