#include "app/commands/plugins_command.h"

#include <algorithm>
#include <string>
#include <vector>

#include "app/terminal/terminal.h"
#include "evaluation/run/contained_run.h"

namespace halyard {

void run_plugins() {
  std::vector<std::string> refused;
  const std::vector<PluginInfo> plugins = contained_plugins(&refused);
  std::size_t width = 0;
  for (const PluginInfo& plugin : plugins) width = std::max(width, plugin.name.size());
  for (const PluginInfo& plugin : plugins) {
    print_out("{:<{}}  {} ({})\n", plugin.name, width, plugin.description, plugin.path.string());
  }
  if (plugins.empty()) print_out("no estimator found; name folders of plug-ins in HALYARD_PLUGIN_PATH\n");
  for (const std::string& reason : refused) print_out("refused: {}\n", reason);
}

}  // namespace halyard
