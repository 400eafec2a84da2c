#include "model/model_file.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <stdexcept>

#include "model/input_error.h"
#include "model/name_list.h"
#include "model/output/number_text.h"
#include "model/xml/arm_checks.h"
#include "model/xml/arm_words.h"
#include "model/xml/field_reader.h"
#include "model/xml/xml_reader.h"
#include "transmission/body_inertia.h"
#include "transmission/coupling.h"

namespace halyard {
namespace {

using Matrix3 = Eigen::Matrix3d;
using Joint = JointParameters<double>;

const char* position_unit(const Joint& joint) { return joint.type == JointType::revolute ? "rad" : "m"; }

void set_frame(Joint& joint, const Matrix3& R, const Eigen::Vector3d& p) {
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&joint.frame_R[0][0]) = R;
  Eigen::Map<Eigen::Vector3d>(joint.frame_p) = p;
}

Matrix3 rotation(double angle, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// Refuses an angle of a fixed rotation beyond one turn: it is in degrees.
void check_angle(const XmlElement& element, std::string_view attribute, double angle) {
  if (std::abs(angle) <= 2 * std::numbers::pi) return;
  element.fail(attribute, "expected an angle of at most one turn, 2 pi rad; write deg behind a number in degrees");
}

double fixed_angle(const XmlElement& element, std::string_view attribute) {
  const double angle = element.number(attribute, "rad");
  check_angle(element, attribute, angle);
  return angle;
}

/// T(i-1,i) = Rx(alpha) Tx(a) Rz(theta) Tz(d) at q = 0 (Craig).
void read_dh(const XmlElement& dh, Joint& joint) {
  dh.only({"alpha", "a", "theta", "d"});
  const Matrix3 Rx = rotation(fixed_angle(dh, "alpha"), Eigen::Vector3d::UnitX());
  const Matrix3 R = Rx * rotation(fixed_angle(dh, "theta"), Eigen::Vector3d::UnitZ());
  set_frame(joint, R, Rx * Eigen::Vector3d(dh.number("a", "m"), 0, dh.number("d", "m")));
}

/// In the sense of least squares (orthogonal Procrustes problem). One that is as exact as its digits stays as it is.
Matrix3 nearest_rotation(const Matrix3& R) {
  constexpr double kExact = 1e-14;
  if ((R * R.transpose()).isApprox(Matrix3::Identity(), kExact)) return R;
  const Eigen::JacobiSVD<Matrix3> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

void read_frame(const XmlElement& frame, Joint& joint) {
  frame.only({"xyz", "rpy", "matrix"});
  if (frame.has("rpy") == frame.has("matrix")) frame.fail("expected one of rpy and matrix; give one rotation");
  const std::vector<double> xyz = frame.numbers("xyz", "m", 3);
  Matrix3 R;
  if (frame.has("matrix")) {
    const std::vector<double> rows = frame.numbers("matrix", "", 9);
    R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
    // A matrix typed with 6 digits passes, one with a wrong sign or scale does not.
    if (!(R * R.transpose()).isApprox(Matrix3::Identity(), 1e-5) || R.determinant() < 0) {
      frame.fail("matrix", "expected a rotation matrix, row by row; its rows are not orthonormal and right-handed");
    }
    R = nearest_rotation(R);
  } else {
    const std::vector<double> rpy = frame.numbers("rpy", "rad", 3);
    for (const double angle : rpy) check_angle(frame, "rpy", angle);
    R = rotation(rpy[2], Eigen::Vector3d::UnitZ()) * rotation(rpy[1], Eigen::Vector3d::UnitY()) *
        rotation(rpy[0], Eigen::Vector3d::UnitX());
  }
  set_frame(joint, R, {xyz[0], xyz[1], xyz[2]});
}

void check_inertia(const XmlElement& link, const Joint& joint, const std::string& name) {
  const Eigen::Vector3d moments = principal_moments(joint);
  const std::string principal = "joint " + in_quotes(name) + " has principal moments " + exact_text(moments(0)) + ", " +
                                exact_text(moments(1)) + ", " + exact_text(moments(2)) + " kg m^2; expected ";
  switch (find_inertia_fault(moments)) {
    case InertiaFault::none: return;
    case InertiaFault::negative_moment: link.fail("inertia", principal + "none below 0; check the signs of xy, xz, yz");
    case InertiaFault::triangle_inequality:
      link.fail("inertia", principal +
                               "none above the sum of the other two (no body has that); check the entries, which "
                               "are xx yy zz xy xz yz about the centre of mass");
  }
}

void read_link(const XmlElement& link, Joint& joint, const std::string& name) {
  read_fields(link, joint);
  check_inertia(link, joint, name);
}

void read_couplings(const std::vector<XmlElement>& couplings, Joint& joint, int k) {
  std::set<std::int64_t> given;
  for (const XmlElement& coupling : couplings) {
    coupling.only({"joint", "coefficient"});
    if (k == 0) coupling.fail("the first joint has no inboard joint that could move its cable; remove it");
    const std::int64_t inboard = coupling.integer("joint", 1, kMaxJoints);
    if (inboard > k)
      coupling.fail("joint", "expected the number of a joint nearer the base, 1 to " + std::to_string(k) +
                                 ": only its motion moves this cable");
    if (!given.insert(inboard).second) coupling.fail("joint", "coupling with this joint is given twice; give it once");
    joint.coupling[inboard - 1] = coupling.number("coefficient", "");
  }
}

ControllerParameters read_controller(const XmlElement& controller) {
  controller.only({"kp", "kd", "torque_limit"});
  ControllerParameters gains;
  gains.kp = controller.number("kp", "N m/rad", Sign::non_negative);
  gains.kd = controller.number("kd", "N m s/rad", Sign::non_negative);
  gains.torque_limit = controller.number_or("torque_limit", 0, "N m", Sign::non_negative);
  return gains;
}

void read_range(const XmlElement& range, const char* unit, JointDescription& description) {
  range.only({"lower", "upper", "home"});
  description.lower = range.number("lower", unit);
  description.upper = range.number("upper", unit);
  description.home = range.number("home", unit);
  if (!(description.lower < description.upper)) range.fail("upper", "expected an upper end above the lower one");
  if (description.home < description.lower || description.home > description.upper) {
    range.fail("home", "expected a position from lower to upper");
  }
}

Tolerances read_tolerances(const XmlElement& element, Tolerances tolerances) {
  XmlNames names;
  for_each_tolerance([&](const char* name, double Tolerances::*) { names.push_back(name); });
  element.only(names);
  for_each_tolerance([&](const char* name, double Tolerances::*member) {
    tolerances.*member = element.number_or(name, tolerances.*member, "", Sign::non_negative);
  });
  return tolerances;
}

void read_drive(const XmlElement& element, Joint& joint, int k, ControllerParameters& controller) {
  const auto refuse = [&](const char* tag, const char* drive) {
    if (const auto found = element.optional_child(tag)) {
      found->fail(std::string("a joint with drive=\"") + drive + "\" has none; remove it, or change the drive");
    }
  };
  if (joint.drive == Drive::none) {
    for (const char* tag : {"motor", "cable", "rigid", "coupling", "controller"}) refuse(tag, "none");
    return;
  }
  const char *own = joint.drive == Drive::cable ? "cable" : "rigid",
             *other = joint.drive == Drive::cable ? "rigid" : "cable";
  read_fields(element.child("motor"), joint);
  refuse(other, own);
  read_fields(element.child(own), joint);
  read_couplings(element.children("coupling"), joint, k);
  if (const auto found = element.optional_child("controller")) controller = read_controller(*found);
}

JointDescription read_joint(const XmlElement& element, Joint& joint, int k, const Tolerances& tolerances) {
  element.only({"name", "type", "drive"}, {"dh", "frame", "link", "motor", "cable", "rigid", "coupling", "friction",
                                           "encoders", "controller", "range", "tolerances"});
  JointDescription description;
  description.name = element.text("name");
  joint.type = element.choice("type", words_of(joint.type));
  joint.drive = element.choice("drive", words_of(joint.drive));
  joint.coupling[k] = 1;

  const auto dh = element.optional_child("dh"), frame = element.optional_child("frame");
  if (dh.has_value() == frame.has_value()) element.fail("expected one of <dh> and <frame>; give one frame");
  if (dh) read_dh(*dh, joint);
  if (frame) read_frame(*frame, joint);
  read_link(element.child("link"), joint, description.name);
  read_drive(element, joint, k, description.controller);
  read_fields(element.child("friction"), joint);
  if (const auto found = element.optional_child("encoders")) read_encoders(*found, joint);
  read_range(element.child("range"), position_unit(joint), description);
  const auto own = element.optional_child("tolerances");
  description.tolerances = own ? read_tolerances(*own, tolerances) : tolerances;
  return description;
}

/// Every joint has something to move, or its acceleration would be undefined.
void check_inertia_of_motion(const ArmParameters<double>& arm, const Eigen::VectorXd& home,
                             const std::vector<XmlElement>& elements) {
  double mass = 0, inertia = 0;
  for (int k = arm.n - 1; k >= 0; --k) {
    const Joint& joint = arm.joint[k];
    mass += joint.mass;
    inertia += joint.inertia[0] + joint.inertia[1] + joint.inertia[2];
    const bool has_rotor = joint.drive == Drive::rigid && joint.rotor_inertia > 0;
    if (has_rotor || mass > 0 || (joint.type == JointType::revolute && inertia > 0)) continue;
    elements[k].fail("this joint moves no mass; give its link or a link outboard of it a mass");
  }
  if (const auto k = joint_without_inertia(arm, home))
    elements[*k].fail(
        "at home this joint moves without inertia while the joints inboard of it are free (the mass matrix is "
        "singular); give its link or a link outboard of it an inertia about its axis");
}

void check_coupling(const ArmParameters<double>& arm, const XmlElement& element) {
  try {
    unstretched_joints(arm, Eigen::VectorXd::Zero(arm.n), Eigen::VectorXd::Zero(arm.n));
  } catch (const std::invalid_argument& error) {
    element.fail(error.what());
  }
}

void read_joints(const XmlElement& arm, const Tolerances& tolerances, ArmModel& model) {
  const std::vector<XmlElement> elements = arm.children("joint");
  if (elements.empty()) arm.fail("element <joint> is missing; give 1 to " + std::to_string(kMaxJoints));
  if (elements.size() > kMaxJoints) {
    elements[kMaxJoints].fail("the arm has " + std::to_string(elements.size()) + " joints; expected 1 to " +
                              std::to_string(kMaxJoints));
  }
  model.nominal.n = static_cast<int>(elements.size());
  for (int k = 0; k < model.nominal.n; ++k) {
    JointDescription description = read_joint(elements[k], model.nominal.joint[k], k, tolerances);
    for (const JointDescription& inboard : model.joints) {
      if (inboard.name == description.name) elements[k].fail("name", "another joint has this name; give it its own");
    }
    model.joints.push_back(std::move(description));
  }
  check_inertia_of_motion(model.nominal, model.home(), elements);
  check_coupling(model.nominal, arm);
}

PlacedEffect read_effect(const XmlElement& element, const ArmParameters<double>& arm) {
  const Effect* effect = find_effect(element.text("name"));
  if (!effect) {
    std::vector<std::string> known;
    for (const Effect* each : effect_library()) known.push_back(each->name());
    element.fail("name",
                 "unknown effect; expected one of " + listed(known) + ", or one of a module given by --effects");
  }
  if (effect->scope() == EffectScope::arm && element.has("joint")) {
    element.fail("joint", "effect " + effect->name() + " is of the whole arm; remove the joint");
  }
  const bool of_arm = effect->scope() != EffectScope::joint && !element.has("joint");
  EffectPlace joint = kWholeArm;
  if (!of_arm) joint = static_cast<int>(element.integer("joint", 1, arm.n)) - 1;
  PlacedEffect placed;
  std::vector<EffectParameter> parameters;
  try {
    placed = place_effect(*effect, arm, joint);
    parameters = effect->parameters(arm, joint);
    const auto sizes = [&](const EffectParameter& p) { return !p.is_shape() && element.has(p.name); };
    if (std::ranges::any_of(parameters, sizes)) placed = place_neutral_effect(*effect, arm, joint);
  } catch (const std::invalid_argument& error) {
    element.fail("joint", std::string(error.what()) + "; remove the effect");
  }

  XmlNames attributes = {"name", "joint"};
  for (const EffectParameter& parameter : parameters) attributes.push_back(parameter.name);
  element.only(attributes);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const EffectParameter& p = parameters[i];
    const std::string unit = p.unit == "1" ? "" : p.unit;
    placed.p[i] = element.number_or(p.name, placed.p[i], unit);
    if (placed.p[i] >= p.lower && placed.p[i] <= p.upper) continue;
    element.fail(p.name, "expected a number from " + exact_text(p.lower) + " to " + exact_text(p.upper) +
                             (unit.empty() ? "" : " " + unit));
  }
  if (const std::string fault = effect->fault_of(placed.p); !fault.empty()) element.fail(fault);
  return placed;
}

/// Refuses effects of a kind at one joint, each within its bounds, whose shares are together more than one may have.
void check_sums(const std::vector<XmlElement>& elements, const ArmModel& model,
                const std::vector<PlacedEffect>& placed) {
  for (std::size_t e = 0; e < placed.size(); ++e) {
    const PlacedEffect& effect = placed[e];
    const std::vector<EffectParameter> parameters = effect.effect->parameters(model.nominal, effect.joint);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const EffectParameter& p = parameters[i];
      if (p.unit != "1" || p.neutral != 0 || p.is_shape()) continue;
      double sum = 0;
      for (const PlacedEffect& other : model.effects) sum += same_name(other, effect) ? other.p[i] : 0;
      for (std::size_t before = 0; before <= e; ++before)
        sum += same_name(placed[before], effect) ? placed[before].p[i] : 0;
      const double rounding = 1e-9 * std::max(std::abs(p.lower), std::abs(p.upper));
      if (sum >= p.lower - rounding && sum <= p.upper + rounding) continue;
      elements[e].fail(p.name, "with the other effects of this kind at the joint it is " + with_digits(sum, 6) +
                                   ", expected a sum from " + exact_text(p.lower) + " to " + exact_text(p.upper));
    }
  }
}

/// Refuses effects that are each within their bounds but together change the arm to one that cannot be.
void check_changed_arm(const std::vector<XmlElement>& elements, const ArmModel& model,
                       const std::vector<PlacedEffect>& placed) {
  if (placed.empty()) return;
  std::vector<PlacedEffect> all = model.effects;
  all.insert(all.end(), placed.begin(), placed.end());
  const Eigen::VectorXd home = model.home();
  const auto fault = first_fault(model.nominal, all, [&](const auto& before, const auto& after) {
    std::string what = number_outside_bound(before, after);
    if (!what.empty()) return what;
    if (const auto k = joint_without_inertia(after, home))
      what = "joint " + std::to_string(*k + 1) + " moves without inertia at home (the mass matrix is singular)";
    return what;
  });
  if (!fault) return;
  const std::size_t given = model.effects.size();  // these were good when they were read
  elements[fault->effect < given ? 0 : fault->effect - given].fail(
      "with " + effect_label(all[fault->effect]) + (fault->effect > 0 ? " after the effects before it, " : ", ") +
      fault->what + "; make the change smaller, or remove one of the effects");
}

void read_columns(const XmlElement& columns, ArmModel& model) {
  columns.only({}, {"column"});
  for (const XmlElement& column : columns.children()) {
    const bool is_left_out = column.flag_or("left_out", false);
    column.only(is_left_out ? XmlNames{"name", "left_out"}
                            : XmlNames{"name", "from", "left_out", "unit", "sign", "scale", "offset", "wrap"});
    const std::string name = column.text("name"), unit = column.text_or("unit", "");
    const std::string from = is_left_out ? "" : column.text("from");
    const double sign = column.number_or("sign", 1, ""), scale = column.number_or("scale", 1, "");
    const double offset = column.number_or("offset", 0, ""), wrap = column.number_or("wrap", 0, "");
    try {
      if (is_left_out) model.columns.leave_out(name);
      else model.columns.add(name, from, unit, sign, scale, offset, wrap);
      model.columns.check_joints(model.n());
    } catch (const InputError& error) {
      column.fail(error.what());
    }
  }
}

void read_estimator(const XmlElement& element, ArmModel& model) {
  element.only_children({});
  const std::string name = element.text("name");
  EstimatorOptions options;
  for (const auto& [key, value] : element.attributes()) {
    if (key != "name") options.emplace(key, value);
  }
  if (!model.estimators.emplace(name, options).second) {
    element.fail("name", "options of this estimator are given twice; put them in one element");
  }
}

ArmModel read_arm(const XmlElement& arm) {
  arm.only({"name"}, {"gravity", "payload", "tolerances", "joint", "effects", "columns", "estimator"});
  ArmModel model;
  model.source = arm.source();
  model.name = arm.text("name");
  read_arm_fields(arm, model.nominal);
  Tolerances tolerances;
  if (const auto found = arm.optional_child("tolerances")) tolerances = read_tolerances(*found, tolerances);
  read_joints(arm, tolerances, model);
  if (const auto effects = arm.optional_child("effects")) model.effects = read_effects(*effects, model);
  if (const auto columns = arm.optional_child("columns")) read_columns(*columns, model);
  for (const XmlElement& estimator : arm.children("estimator")) read_estimator(estimator, model);
  return model;
}

}  // namespace

std::vector<PlacedEffect> read_effects(const XmlElement& effects, const ArmModel& model) {
  effects.only({}, {"effect"});
  std::vector<PlacedEffect> placed;
  for (const XmlElement& effect : effects.children()) placed.push_back(read_effect(effect, model.nominal));
  check_sums(effects.children(), model, placed);
  check_changed_arm(effects.children(), model, placed);
  return placed;
}

ArmModel read_model(const std::filesystem::path& path) { return read_arm(XmlElement::read_file(path, "arm")); }

ArmModel parse_model(const std::string& xml, const std::string& source) {
  return read_arm(XmlElement::parse(xml, source, "arm"));
}

}  // namespace halyard
