// Has no speed for a joint without a motor; with the option `refuses` it refuses such an arm.
#include <limits>

#include "behaving.h"
#include "model/input_error.h"

class NeedsMotors : public Behaving {
 public:
  NeedsMotors(const halyard::ArmModel& model, const halyard::EstimatorOptions& options)
      : Behaving(model, options), arm_(model.nominal) {
    for (int k = 0; k < arm_.n; ++k)
      if (arm_.joint[k].drive == halyard::Drive::none && options.contains("refuses"))
        throw halyard::InputError("joint " + std::to_string(k + 1) + " has no motor; give it one");
  }
  halyard::Estimate estimate() const override {
    halyard::Estimate estimate = Behaving::estimate();
    for (int k = 0; k < arm_.n; ++k)
      if (arm_.joint[k].drive == halyard::Drive::none)
        estimate.joint_velocity(k) = std::numeric_limits<double>::quiet_NaN();
    return estimate;
  }

 private:
  halyard::ArmParameters<double> arm_;
};

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = halyard::estimator_table<NeedsMotors>("needs_motors", "divides by motors");
  return &table;
}
