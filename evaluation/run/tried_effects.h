#pragma once

#include <filesystem>

#include "evaluation/run/contained_run.h"

namespace halyard {

/// load_effects() (plugins/host/effect_module.h) for a module that is not trusted: a worker loads it first, with the
/// limit of a step. A module that crashes, hangs or ends its process there ends only the worker, and is refused.
/// Throws InputError `plugin PATH: as it is loaded: what; remedy` for such a module, InputError as load_effects() does,
/// and InputError if there is no halyard_worker.
void load_tried_effects(const std::filesystem::path& path, const ContainmentOptions& containment = {});

}  // namespace halyard
