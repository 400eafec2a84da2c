#include "behaving.h"

class ThrowsInCreate : public Behaving {
 public:
  ThrowsInCreate(const halyard::ArmModel& model, const halyard::EstimatorOptions& options) : Behaving(model, options) {
    if (options.empty()) throw std::runtime_error("the table of gains is lost");
    throw halyard::InputError("option '" + options.begin()->first + "': unknown; there are none");
  }
};

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = halyard::estimator_table<ThrowsInCreate>("throws_in_create", "throws when made");
  return &table;
}
