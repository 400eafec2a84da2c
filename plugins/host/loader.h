#pragma once
/// Finds, checks and opens estimator plug-ins.

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "estimators/estimator.h"
#include "model/arm_model.h"

namespace halyard {

/// A loadable estimator.
struct PluginInfo {
  std::string name;
  std::string description;
  std::filesystem::path path;
};

/// The plug-in folders that exist, in the order in which they are searched: beside the program (../lib/halyard/plugins
/// in an installation, plugins/ in a build tree), beside halyard's libraries (for programs installed elsewhere), and
/// each folder of the environment variable HALYARD_PLUGIN_PATH, separated by ':'.
std::vector<std::filesystem::path> plugin_folders();
/// Sets the folders that plugin_folders() returns from now on. For a process that works for another process and must
/// find the same plug-ins. No other thread may look for plug-ins meanwhile.
void search_plugins_only_in(std::vector<std::filesystem::path> folders);

/// What a module says of itself. Throws InputError for a file that is no estimator.
PluginInfo describe_module(const std::filesystem::path& path);

/// All loadable estimators in the plug-in folders. If two have the same name, the first one counts. Modules that are
/// refused are not listed; their one-line reasons are appended to `refused` if given. A module's own code runs as it is
/// described: contained_plugins() in evaluation/run/contained_run.h lets it do so in another process.
std::vector<PluginInfo> find_plugins(
    std::vector<std::string>* refused = nullptr,
    const std::function<PluginInfo(const std::filesystem::path&)>& describe = describe_module);

/// The plug-in that make_estimator() uses for a name or path. Throws InputError as make_estimator() does.
PluginInfo find_plugin(const std::string& name_or_path);

/// True for the path of a module; false for the name of a plug-in.
bool is_module_path(const std::string& name);

/// Makes an estimator for the model. name_or_path is the name of a plug-in that find_plugins() lists, or the path of a
/// module (any text that contains a '/' or ends in .so). The estimator gets the options that the model has under its
/// name. The module stays open as long as the estimator lives. Throws InputError with one line for an unknown name (the
/// message lists the known ones), a file that is no module, a module built for another interface version, or one that
/// refuses the model or its options.
std::unique_ptr<Estimator> make_estimator(const std::string& name_or_path, const ArmModel& model);

}  // namespace halyard
