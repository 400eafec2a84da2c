#include "model/arm_model.h"

#include <algorithm>
#include <type_traits>

#include "transmission/arm_fields.h"

namespace halyard {
namespace {

double Tolerances::*tolerance_of(FieldKind kind) {
  switch (kind) {
    case FieldKind::length: return &Tolerances::length;
    case FieldKind::mass: return &Tolerances::mass;
    case FieldKind::stiffness: return &Tolerances::stiffness;
    case FieldKind::friction: return &Tolerances::friction;
    case FieldKind::coupling: return &Tolerances::coupling;
    case FieldKind::torque_scale: return &Tolerances::torque_scale;
    case FieldKind::structure:
    case FieldKind::smoothing:
    case FieldKind::torque_bias:
    case FieldKind::gravity:
    case FieldKind::sensor: break;
  }
  return nullptr;
}

void add_named_parameters(ArmParameters<double>& arm, int k, std::vector<ParameterInfo>& all) {
  JointParameters<double>& joint = arm.joint[k];
  const auto number = [](int i) { return "joint" + std::to_string(i + 1); };
  const auto words = [](int i) { return "joint " + std::to_string(i + 1); };
  const auto visit = [&](const ArmField& field, auto& value) {
    if (field.noun.empty() || !field.exists_at(joint.drive)) return;
    const std::string part(field.part_at(joint.drive)), name(field.name), noun(field.noun);
    double Tolerances::*const tolerance = tolerance_of(field.kind);
    using Value = std::remove_reference_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, double>) {
      const std::string of_part = part == "friction" ? "" : part + " ";  // "joint 1 viscous friction"
      all.push_back({words(k) + " " + of_part + noun, number(k) + "." + part + "." + name, field.unit.of(joint.type), k,
                     tolerance, &value});
    } else if constexpr (std::is_same_v<Value, double[kMaxJoints]>) {
      for (int j = 0; j < k; ++j)
        all.push_back({words(k) + " " + noun + " with " + words(j), number(k) + "." + part + "." + number(j),
                       coupling_unit(joint.type, arm.joint[j].type), k, tolerance, &value[j]});
    }
  };
  for_each_joint_field(visit, joint);
}

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
  for (int k = 0; k < arm.n; ++k) add_named_parameters(arm, k, all);
  return all;
}

}  // namespace halyard
