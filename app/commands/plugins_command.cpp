#include "app/commands/plugins_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <vector>

#include "evaluation/run/contained_run.h"

namespace halyard {

void run_plugins() {
  std::vector<std::string> refused;
  const std::vector<PluginInfo> plugins = contained_plugins(&refused);
  std::size_t width = 0;
  for (const PluginInfo& plugin : plugins) width = std::max(width, plugin.name.size());
  for (const PluginInfo& plugin : plugins) {
    fmt::print("{:<{}}  {} ({})\n", plugin.name, width, plugin.description, plugin.path.string());
  }
  if (plugins.empty()) fmt::print("no estimator found; name folders of plug-ins in HALYARD_PLUGIN_PATH\n");
  for (const std::string& reason : refused) fmt::print("refused: {}\n", reason);
}

}  // namespace halyard
