#pragma once
/// A shared module that was checked to be an estimator plug-in.

#include "plugins/halyard_estimator.h"
#include "plugins/host/shared_module.h"

namespace halyard {

class EstimatorModule {
 public:
  /// Loads the module and checks its table, the interface version first. Throws InputError `plugin PATH: what; remedy`
  /// as SharedModule does. Throws it also if the module lacks the exported function or was built for another interface
  /// version, or if its table is too small or lacks an entry.
  explicit EstimatorModule(const std::filesystem::path& path);

  const halyard_estimator_table& table() const { return *table_; }
  const std::filesystem::path& path() const { return module_.path(); }

 private:
  SharedModule module_;
  const halyard_estimator_table* table_;
};

}  // namespace halyard
