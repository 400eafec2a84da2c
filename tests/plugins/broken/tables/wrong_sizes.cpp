#include "behaving.h"

class WrongSizes : public Behaving {
 public:
  using Behaving::Behaving;
  halyard::Estimate estimate() const override {
    halyard::Estimate estimate = Behaving::estimate();
    estimate.joint_velocity.resize(0);
    return estimate;
  }
};

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = halyard::estimator_table<WrongSizes>("wrong_sizes", "vectors of other sizes");
  return &table;
}
