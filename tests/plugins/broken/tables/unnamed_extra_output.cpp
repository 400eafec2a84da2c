#include "behaving.h"

class Unnamed : public Behaving {
 public:
  using Behaving::Behaving;
  halyard::Estimate estimate() const override {
    halyard::Estimate estimate = Behaving::estimate();
    estimate.extra_outputs.setOnes(estimate.joint_position.size(), 2);
    return estimate;
  }
};

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = halyard::estimator_table<Unnamed>("unnamed_extra_output", "columns without names");
  return &table;
}
