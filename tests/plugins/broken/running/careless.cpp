// Works, and breaks one promise after the other: the state is shared by all instances and outlives reset().
#include <cmath>

#include "behaving.h"

class Careless : public Behaving {
 public:
  using Behaving::Behaving;
  halyard::Innovation update(const halyard::Sample& sample) override {
    if (!std::isnan(sample.motor_position(0))) sum_ += sample.motor_position(0);
    return Behaving::update(sample);
  }
  halyard::Estimate estimate() const override {
    halyard::Estimate estimate = Behaving::estimate();
    estimate.joint_position(0) = sum_;
    return estimate;
  }
  halyard::EstimatorReport report() const override { return {}; }

 private:
  static inline double sum_ = 0;
};

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = halyard::estimator_table<Careless>("careless", "one state for all instances");
  return &table;
}
