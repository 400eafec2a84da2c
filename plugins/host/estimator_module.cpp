#include "plugins/host/estimator_module.h"

#include <array>
#include <utility>

#include "model/input_error.h"
#include "plugins/host/plain_name.h"

namespace halyard {
namespace {

constexpr const char* kSymbol = "halyard_estimator";
constexpr const char* kRebuild = "; rebuild it against the installed headers";
constexpr const char* kUpgrade = "; install a newer halyard, or rebuild it against these headers";

const halyard_estimator_table* checked_table(const SharedModule& module) {
  const auto refuse = [&](const std::string& why) {
    throw InputError("plugin " + module.path().string() + ": " + why);
  };

  const auto exported = reinterpret_cast<decltype(&halyard_estimator)>(module.symbol(kSymbol));
  if (!exported)
    refuse(std::string("exports no function ") + kSymbol + "; it is no estimator, or its function lacks extern \"C\"");
  const halyard_estimator_table* table = called(exported, module, kSymbol);
  if (!table) refuse(std::string(kSymbol) + "() returns no table; return the address of a static one");

  const std::uint32_t version = table->interface_version;
  if (version != HALYARD_ESTIMATOR_INTERFACE) {
    refuse("built for interface " + std::to_string(version) + ", this program speaks " +
           std::to_string(HALYARD_ESTIMATOR_INTERFACE) + (version < HALYARD_ESTIMATOR_INTERFACE ? kRebuild : kUpgrade));
  }
  if (table->table_size < sizeof *table) {
    refuse("its table has " + std::to_string(table->table_size) + " bytes, interface " + std::to_string(version) +
           " has " + std::to_string(sizeof *table) + kRebuild);
  }
  const std::array<std::pair<const char*, bool>, 8> entries = {{{"name", table->name},
                                                                {"description", table->description},
                                                                {"create", table->create},
                                                                {"destroy", table->destroy},
                                                                {"reset", table->reset},
                                                                {"update", table->update},
                                                                {"estimate", table->estimate},
                                                                {"report", table->report}}};
  for (const auto& [entry, given] : entries)
    if (!given) refuse(std::string("its table lacks '") + entry + "'; fill every entry");
  if (!is_plain_name(table->name)) {
    refuse("its name " + in_quotes(table->name) +
           " cannot be used; name it with letters, digits, '_' and '-', at most 64");
  }
  return table;
}

}  // namespace

EstimatorModule::EstimatorModule(const std::filesystem::path& path) : module_(path), table_(checked_table(module_)) {}

}  // namespace halyard
