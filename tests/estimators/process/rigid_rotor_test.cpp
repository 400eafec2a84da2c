/// The rotor of a rigid drive, where the chain of an earlier step is kept.

#include <gtest/gtest.h>

#include <cmath>

#include "estimators/built_in.h"
#include "tests/support/arm_runs.h"
#include "tests/support/limits.h"

namespace halyard {
namespace {

/// A rigid slide with so much mass in its link and in its rotor.
ArmModel rigid_slide(const std::string& link, const std::string& rotor) {
  return parse_model(R"(<arm name="slide"><gravity>0 0 0</gravity><joint name="slide" type="prismatic" drive="rigid">
<dh alpha="0" a="0" theta="0" d="0"/><link mass=")" +
                         link + R"(" com="0 0 0" inertia="0 0 0 0 0 0"/><motor inertia=")" + rotor +
                         R"(" coulomb="0.5" viscous="2" smoothing="0.1" gear_ratio="1" capstan_radius="1"/>
<rigid pulley_radius="1"/><friction coulomb="0" viscous="0" smoothing="0.1"/>
<encoders motor_resolution="1e-5" joint_resolution="1e-6"/><controller kp="0" kd="0" torque_limit="0"/>
<range lower="-0.3" upper="0.3" home="0"/></joint></arm>)",
                     "slide.xml");
}

TEST(RigidRotor, IsNoOtherMassThanThatOfTheLink) {
  const ArmModel in_link = rigid_slide("21", "0"), in_rotor = rigid_slide("1", "20");
  for (const auto make : {&make_ekf, &make_sr_ukf}) {
    const auto one = make(in_link, {}), other = make(in_rotor, {});
    for (int i = 0; i <= 100; ++i) {
      const double t = 1e-3 * i, accelerated = 1 - std::cos(20 * t);
      const Sample s{t,
                     Eigen::VectorXd::Constant(1, 100 * std::cos(20 * t)),
                     Eigen::VectorXd::Constant(1, 0.012 * accelerated),
                     {}};
      for (Estimator* const filter : {one.get(), other.get()}) {
        if (i == 0) filter->reset(s);
        else filter->update(s);
      }
    }
    // Rounding; with a rotor that was left out, the two were 5 mm and 156 mm/s apart.
    const Estimate a = one->estimate(), b = other->estimate();
    EXPECT_NEAR(a.joint_position(0), b.joint_position(0), 1e-12);
    EXPECT_NEAR(a.joint_velocity(0), b.joint_velocity(0), 1e-10);
    EXPECT_NEAR(a.joint_position_std(0), b.joint_position_std(0), 1e-12);
  }
}

TEST(RigidRotor, IsAcceleratedFromAChainThatIsKept) {
  ArmModel model = raven2();
  for (const int k : {0, 1, 2}) {
    model.nominal.joint[k].drive = Drive::rigid;
    model.nominal.joint[k].rotor_inertia *= 10;
  }
  const ProcessModel process(model);
  Eigen::VectorXd x = process.state_at_rest(unstretched_motors(process.arm(), model.home()), model.home()), x_dot;
  const Eigen::Vector3d before(0.1, -0.1, 0.05), torque(-0.05, 0.1, 0.02);
  Eigen::MatrixXd A;
  LinearisedPoint point;
  process.linearise({0, 1e-3, before.data()}, x, nullptr, x_dot, A, point);
  // At the same pose M is the same, so that the kept one is exact.
  for (int k = 0; k < 3; ++k) x(process.layout().rate[k]) = 0.3 - 0.2 * k;
  const Step step{0, 1e-3, torque.data()};
  process.linearise(step, x, &point.chain, x_dot, A, point);
  const Eigen::VectorXd expected = process.derivative(step, x);
  EXPECT_LT((x_dot - expected).norm(), 100 * kEps * expected.norm());
}

}  // namespace
}  // namespace halyard
