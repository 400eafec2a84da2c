#include "model/arm_model.h"

#include <algorithm>

namespace halyard {
namespace {

/// Unit of what joint j adds to joint i's cable path, in units of joint i per unit of joint j.
std::string coupling_unit(JointType i, JointType j) {
  if (i == j) return "1";
  return i == JointType::prismatic ? "m/rad" : "rad/m";
}

/// The numbers of joint k, in the order of a model file.
class Lister {
 public:
  Lister(ArmParameters<double>& arm, int k, std::vector<ParameterInfo>& all)
      : arm_(arm), joint_(arm.joint[k]), k_(k), all_(all) {}

  void list() {
    const bool revolute = joint_.type == JointType::revolute;
    add("link mass", "link.mass", "kg", &Tolerances::mass, joint_.mass);
    if (joint_.drive != Drive::none) {
      add("motor inertia", "motor.inertia", "kg m^2", &Tolerances::mass, joint_.rotor_inertia);
      add("motor Coulomb friction", "motor.coulomb", "N m", &Tolerances::friction, joint_.motor_coulomb);
      add("motor viscous friction", "motor.viscous", "N m s/rad", &Tolerances::friction, joint_.motor_viscous);
      add("motor gear ratio", "motor.gear_ratio", "1", &Tolerances::length, joint_.gear_ratio);
      add("motor capstan radius", "motor.capstan_radius", "m", &Tolerances::length, joint_.capstan_radius);
      add("motor torque scale", "motor.torque_scale", "1", &Tolerances::torque_scale, joint_.torque_scale);
      add("motor torque bias", "motor.torque_bias", "N m", nullptr, joint_.torque_bias);
    }
    if (joint_.drive == Drive::cable) {
      add("cable stiffness", "cable.stiffness", "N/m", &Tolerances::stiffness, joint_.stiffness);
      add("cable damping", "cable.damping", "N s/m", &Tolerances::stiffness, joint_.damping);
      add("cable tension", "cable.tension", "N", &Tolerances::stiffness, joint_.tension);
    }
    if (joint_.drive != Drive::none) {
      const std::string drive = joint_.drive == Drive::cable ? "cable" : "rigid";
      add(drive + " pulley radius", drive + ".pulley_radius", revolute ? "m" : "1", &Tolerances::length,
          joint_.pulley_radius);
      for (int j = 0; j < k_; ++j) {
        const std::string other = std::to_string(j + 1);
        add("coupling with joint " + other, "coupling.joint" + other, coupling_unit(joint_.type, arm_.joint[j].type),
            &Tolerances::coupling, joint_.coupling[j]);
      }
    }
    add("Coulomb friction", "friction.coulomb", revolute ? "N m" : "N", &Tolerances::friction, joint_.joint_coulomb);
    add("viscous friction", "friction.viscous", revolute ? "N m s/rad" : "N s/m", &Tolerances::friction,
        joint_.joint_viscous);
  }

 private:
  void add(const std::string& name, const std::string& key, const std::string& unit, double Tolerances::*tolerance,
           double& value) {
    const std::string number = std::to_string(k_ + 1);
    all_.push_back({"joint " + number + " " + name, "joint" + number + "." + key, unit, k_, tolerance, &value});
  }

  ArmParameters<double>& arm_;
  JointParameters<double>& joint_;
  int k_;
  std::vector<ParameterInfo>& all_;
};

}  // namespace

Eigen::VectorXd ArmModel::home() const {
  Eigen::VectorXd q(joints.size());
  for (std::size_t k = 0; k < joints.size(); ++k) q(k) = joints[k].home;
  return q;
}

double ArmModel::tolerance(const ParameterInfo& number) const {
  return number.tolerance ? joints[number.joint].tolerances.*number.tolerance : 0;
}

bool joints_alike(const ArmParameters<double>& a, const ArmParameters<double>& b) {
  if (a.n != b.n) return false;
  const auto alike = [](const JointParameters<double>& j, const JointParameters<double>& other) {
    return j.type == other.type && (j.drive == Drive::none) == (other.drive == Drive::none);
  };
  return std::equal(a.joint, a.joint + a.n, b.joint, alike);
}

std::vector<ParameterInfo> named_parameters(ArmParameters<double>& arm) {
  std::vector<ParameterInfo> all;
  for (int k = 0; k < arm.n; ++k) Lister(arm, k, all).list();
  return all;
}

}  // namespace halyard
