#include "plugins/host/loader.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <set>
#include <sstream>

#include "model/input_error.h"
#include "model/name_list.h"
#include "plugins/host/estimator_module.h"
#include "plugins/host/plugin_estimator.h"
#include "plugins/host/program_location.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;

std::optional<std::vector<fs::path>>& only_folders() {
  static std::optional<std::vector<fs::path>> folders;
  return folders;
}

/// The folders that are there, in the order in which they are searched.
std::vector<fs::path> folders_to_search(std::vector<std::string>* refused) {
  if (only_folders()) return *only_folders();
  std::vector<fs::path> folders;
  std::set<fs::path> seen;
  const auto add = [&](const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) return false;
    const fs::path canonical = fs::canonical(folder, error);
    if (seen.insert(canonical).second) folders.push_back(canonical);
    return true;
  };
  add(program_folder() / HALYARD_PLUGINS_FROM_PROGRAM);
  add(program_folder() / "plugins");
  const fs::path own_folder = folder_of_code(&make_estimator);
  add(own_folder / "halyard/plugins");
  add(own_folder / "../plugins");

  const char* from_user = std::getenv("HALYARD_PLUGIN_PATH");
  std::istringstream list(from_user ? from_user : "");
  for (std::string folder; std::getline(list, folder, ':');) {
    if (folder.empty() || add(folder) || !refused) continue;
    refused->push_back("HALYARD_PLUGIN_PATH: " + in_quotes(folder) + " is no folder; correct it or take it out");
  }
  return folders;
}

std::vector<fs::path> modules_in(const fs::path& folder) {
  std::vector<fs::path> modules;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".so") modules.push_back(entry.path());
  std::sort(modules.begin(), modules.end());
  return modules;
}

/// Calls visit(path) for the modules of all folders one after the other, until it returns true. One that it refuses
/// with an InputError is passed over.
template <class Visit>
void search(std::vector<std::string>* refused, const Visit& visit) {
  for (const fs::path& folder : folders_to_search(refused))
    for (const fs::path& path : modules_in(folder)) {
      try {
        if (visit(path)) return;
      } catch (const InputError& error) {
        if (refused) refused->push_back(error.what());
      }
    }
}

std::shared_ptr<const EstimatorModule> named_module(const std::string& name) {
  std::shared_ptr<const EstimatorModule> found;
  std::vector<std::string> refused;
  std::set<std::string> others;
  search(&refused, [&](const fs::path& path) {
    auto module = std::make_shared<const EstimatorModule>(path);
    others.insert(module->table().name);
    if (name == module->table().name) found = module;
    return found != nullptr;
  });
  if (found) return found;

  std::string message = "no estimator is named " + in_quotes(name);
  for (const std::string& reason : refused)
    if (reason.find("/" + name + ".so: ") != std::string::npos) message += " (" + reason + ")";
  message += others.empty() ? "; none was found" : "; found:";
  for (const std::string& other : others) message += " " + other;
  throw InputError(message + "; give one of these, or the path of a module such as ./" + shortened(name) + ".so");
}

std::shared_ptr<const EstimatorModule> open_module(const std::string& name_or_path) {
  return is_module_path(name_or_path) ? std::make_shared<const EstimatorModule>(name_or_path)
                                      : named_module(name_or_path);
}

PluginInfo info(const EstimatorModule& module) {
  return {module.table().name, one_line(module.table().description), module.path()};
}

}  // namespace

bool is_module_path(const std::string& name) { return name.find('/') != std::string::npos || name.ends_with(".so"); }

std::vector<fs::path> plugin_folders() { return folders_to_search(nullptr); }

void search_plugins_only_in(std::vector<fs::path> folders) { only_folders() = std::move(folders); }

PluginInfo describe_module(const fs::path& path) { return info(EstimatorModule(path)); }

std::vector<PluginInfo> find_plugins(std::vector<std::string>* refused,
                                     const std::function<PluginInfo(const fs::path&)>& describe) {
  std::vector<PluginInfo> found;
  search(refused, [&](const fs::path& path) {
    PluginInfo plugin = describe(path);
    const auto first = std::find_if(found.begin(), found.end(), [&](const auto& p) { return p.name == plugin.name; });
    if (first == found.end()) {
      found.push_back(std::move(plugin));
    } else if (refused) {
      refused->push_back("plugin " + plugin.path.string() + ": the name " + in_quotes(plugin.name) + " is taken by " +
                         first->path.string() + "; rename it, or call it by its path");
    }
    return false;
  });
  return found;
}

PluginInfo find_plugin(const std::string& name_or_path) { return info(*open_module(name_or_path)); }

std::unique_ptr<Estimator> make_estimator(const std::string& name_or_path, const ArmModel& model) {
  return std::make_unique<PluginEstimator>(open_module(name_or_path), model);
}

}  // namespace halyard
