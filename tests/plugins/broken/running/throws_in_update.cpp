#include "behaving.h"

class ThrowsInUpdate : public Behaving {
 public:
  using Behaving::Behaving;
  halyard::Innovation update(const halyard::Sample& sample) override {
    if (sample.time_s > 0.0025) throw std::runtime_error("the factor of the covariance is lost");
    if (sample.time_s > 0.0015) throw 42;
    return Behaving::update(sample);
  }
};

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = halyard::estimator_table<ThrowsInUpdate>("throws_in_update", "throws at work");
  return &table;
}
