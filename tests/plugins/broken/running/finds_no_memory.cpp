#include <new>

#include "behaving.h"

class FindsNoMemory : public Behaving {
 public:
  FindsNoMemory(const halyard::ArmModel& model, const halyard::EstimatorOptions& options) : Behaving(model, options) {
    throw std::bad_alloc();
  }
};

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = halyard::estimator_table<FindsNoMemory>("finds_no_memory", "memory runs out as it is made");
  return &table;
}
