#include "model/arm_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "transmission/arm_fields.h"
#include "transmission/transmission.h"

namespace halyard {
namespace {

double Tolerances::*tolerance_of(FieldKind kind) {
  switch (kind) {
    case FieldKind::length: return &Tolerances::length;
    case FieldKind::mass: return &Tolerances::mass;
    case FieldKind::com: return &Tolerances::com;
    case FieldKind::inertia: return &Tolerances::inertia;
    case FieldKind::stiffness: return &Tolerances::stiffness;
    case FieldKind::friction: return &Tolerances::friction;
    case FieldKind::coupling: return &Tolerances::coupling;
    case FieldKind::torque_scale: return &Tolerances::torque_scale;
    case FieldKind::smoothing: return &Tolerances::smoothing;
    case FieldKind::structure:
    case FieldKind::torque_bias:
    case FieldKind::gravity:
    case FieldKind::sensor: break;
  }
  return nullptr;
}

constexpr double kNoLeast = -std::numeric_limits<double>::infinity();

double least_of(Bound bound, double value) {
  constexpr double kNearlyZero = 1e-3;  // of its own value
  return bound == Bound::none ? kNoLeast : kNearlyZero * value;
}

constexpr const char* kAxes[] = {"x", "y", "z"};

/// Root mean square distance of a link's mass from the origin of its joint, m.
double distance_of_mass(const JointParameters<double>& joint) {
  const double trace = joint.inertia[0] + joint.inertia[1] + joint.inertia[2];
  const Eigen::Map<const Eigen::Vector3d> com(joint.com);
  return std::sqrt(com.squaredNorm() + (joint.mass > 0 ? trace / (2 * joint.mass) : 0));
}

ArmNumber largest_moment(double (&inertia)[6]) {
  double* const largest = std::max_element(inertia, inertia + 3);
  std::vector<double*> others;
  for (double& moment : inertia)
    if (&moment != largest) others.push_back(&moment);
  return ArmNumber(*largest, others);
}

/// Calls visit(field, value, numbers) for each field of joint k of which named_parameters() lists so many numbers.
template <class Visit>
void for_each_named_field(JointParameters<double>& joint, int k, const Visit& visit) {
  const auto if_named = [&](const ArmField& field, auto& value) {
    using Value = std::remove_reference_t<decltype(value)>;
    if (field.noun.empty() || !field.exists_at(joint.drive)) return;
    if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, double[6]>) visit(field, value, 1);
    else if constexpr (std::is_same_v<Value, double[3]>) visit(field, value, 3);
    else if constexpr (std::is_same_v<Value, double[kMaxJoints]>) visit(field, value, k);
  };
  for_each_joint_field(if_named, joint);
}

/// The i-th of a field's numbers.
ArmNumber number_of(double& value, int) { return ArmNumber(value); }
ArmNumber number_of(double (&inertia)[6], int) { return largest_moment(inertia); }
template <int size>
ArmNumber number_of(double (&values)[size], int i) {
  return ArmNumber(values[i]);
}

void add_named_parameters(ArmParameters<double>& arm, int k, std::vector<ParameterInfo>& all) {
  JointParameters<double>& joint = arm.joint[k];
  const auto of_joint = [](int i) { return "joint" + std::to_string(i + 1); };
  const auto words = [](int i) { return "joint " + std::to_string(i + 1); };
  for_each_named_field(joint, k, [&](const ArmField& field, auto& value, int numbers) {
    using Value = std::remove_reference_t<decltype(value)>;
    const std::string part(field.part_at(joint.drive)), name(field.name), noun(field.noun);
    double Tolerances::*const tolerance = tolerance_of(field.kind);
    const std::string of_part = part == "friction" ? "" : part + " ";  // "joint 1 viscous friction"
    const std::string in_words = words(k) + " " + of_part + noun, key = of_joint(k) + "." + part + "." + name;
    const char* unit = field.unit.of(joint.type);
    for (int i = 0; i < numbers; ++i) {
      const ArmNumber number = number_of(value, i);
      const double size = std::abs(number.get());
      if constexpr (std::is_same_v<Value, double>)
        all.push_back({in_words, key, unit, k, tolerance, number, size, least_of(field.bound, number.get())});
      else if constexpr (std::is_same_v<Value, double[6]>)
        all.push_back({in_words, key, unit, k, tolerance, number, size, least_of(Bound::positive, number.get())});
      else if constexpr (std::is_same_v<Value, double[3]>)
        all.push_back({in_words + " " + kAxes[i], key + "." + kAxes[i], unit, k, tolerance, number,
                       distance_of_mass(joint), kNoLeast});
      else
        all.push_back({words(k) + " " + noun + " with " + words(i), of_joint(k) + "." + part + "." + of_joint(i),
                       coupling_unit(joint.type, arm.joint[i].type), k, tolerance, number, size, kNoLeast});
    }
  });
}

}  // namespace

Eigen::VectorXd ArmModel::home() const {
  Eigen::VectorXd q(joints.size());
  for (std::size_t k = 0; k < joints.size(); ++k) q(k) = joints[k].home;
  return q;
}

double ArmModel::reach(const ParameterInfo& number) const {
  return number.tolerance ? joints[number.joint].tolerances.*number.tolerance * number.unit_of_tolerance : 0;
}

bool joints_alike(const ArmParameters<double>& a, const ArmParameters<double>& b) {
  if (a.n != b.n) return false;
  const auto alike = [](const JointParameters<double>& j, const JointParameters<double>& other) {
    return j.type == other.type && (j.drive == Drive::none) == (other.drive == Drive::none);
  };
  return std::equal(a.joint, a.joint + a.n, b.joint, alike);
}

ArmParameters<double> arm_with_effects(const ArmModel& model) {
  return Transmission<double>(model.nominal, model.effects).arm();
}

std::vector<ParameterInfo> named_parameters(ArmParameters<double>& arm) {
  std::vector<ParameterInfo> all;
  for (int k = 0; k < arm.n; ++k) add_named_parameters(arm, k, all);
  return all;
}

ArmNumber named_number(ArmParameters<double>& arm, std::size_t index) {
  std::optional<ArmNumber> found;
  int left = static_cast<int>(index);
  for (int k = 0; k < arm.n && !found; ++k)
    for_each_named_field(arm.joint[k], k, [&](const ArmField&, auto& value, int numbers) {
      if (left >= 0 && left < numbers) found = number_of(value, left);
      left -= numbers;
    });
  return found.value();
}

double named_value(const ArmParameters<double>& arm, std::size_t index) {
  return named_number(const_cast<ArmParameters<double>&>(arm), index).get();  // which only reads
}

}  // namespace halyard
