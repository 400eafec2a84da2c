#pragma once

namespace CLI {
class App;
}

namespace halyard {

/// Declare the commands sweep and merge.
void add_sweep_command(CLI::App& app);
void add_merge_command(CLI::App& app);

}  // namespace halyard
