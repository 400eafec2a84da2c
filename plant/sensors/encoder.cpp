#include "plant/sensors/encoder.h"

#include <cmath>

namespace halyard {
namespace {

double rounded(double x, double resolution) { return resolution > 0 ? std::round(x / resolution) * resolution : x; }

}  // namespace

Readings read_encoders(const ArmParameters<double>& arm, const JointSignals<double>* s, bool quantise) {
  Readings r{Eigen::VectorXd::Zero(arm.n), Eigen::VectorXd::Zero(arm.n)};
  for (int k = 0; k < arm.n; ++k) {
    const JointParameters<double>& j = arm.joint[k];
    const double motor = quantise ? j.motor_encoder_resolution : 0, joint = quantise ? j.joint_encoder_resolution : 0;
    if (j.drive != Drive::none) r.motor(k) = rounded(s[k].motor_angle + s[k].motor_error, motor);
    r.joint(k) = rounded(s[k].joint_position + s[k].joint_error, joint);
  }
  return r;
}

}  // namespace halyard
