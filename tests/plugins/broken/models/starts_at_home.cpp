// Demands that the first readings are those of its model at home.
#include <stdexcept>

#include "behaving.h"
#include "transmission/coupling.h"

class StartsAtHome : public Behaving {
 public:
  StartsAtHome(const halyard::ArmModel& model, const halyard::EstimatorOptions& options)
      : Behaving(model, options), arm_(halyard::arm_with_effects(model)), home_(model.home()) {}
  void reset(const halyard::Sample& first) override {
    Eigen::VectorXd motors = first.motor_position;
    for (int k = 0; k < arm_.n; ++k) motors(k) -= arm_.joint[k].motor_encoder_offset;
    const Eigen::VectorXd away = halyard::unstretched_joints(arm_, motors, home_) - home_;
    if (away.cwiseAbs().maxCoeff() > 1e-9) throw std::runtime_error("does not start at home");
    Behaving::reset(first);
  }

 private:
  halyard::ArmParameters<double> arm_;
  Eigen::VectorXd home_;
};

extern "C" const halyard_estimator_table* halyard_estimator() {
  static const auto table = halyard::estimator_table<StartsAtHome>("starts_at_home", "believes in its model");
  return &table;
}
