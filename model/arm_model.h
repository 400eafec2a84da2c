#pragma once
/// A cable-driven serial arm as a model file describes it: the numbers of the equations, the effects
/// that are placed on it, its controller, how foreign logs of it are read, and options of estimators.

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "model/column_map.h"
#include "model/tolerances.h"
#include "transmission/effect.h"

namespace halyard {

/// PD control of one motor at the motor shaft: τ = kp (q_m,d - q_m) + kd (q_m,d' - q_m'), |τ| <= limit.
struct ControllerParameters {
  double kp = 0;            ///< N m/rad
  double kd = 0;            ///< N m s/rad
  double torque_limit = 0;  ///< N m; 0: none
};

/// What a model says of a joint beside its equations' numbers.
struct JointDescription {
  std::string name;
  double lower = 0, upper = 0;  ///< range, rad | m
  double home = 0;              ///< where motor angles are counted from and where runs start, rad | m
  ControllerParameters controller;
  Tolerances tolerances;
};

/// Options of one estimator, by name, as text; the estimator checks them.
using EstimatorOptions = std::map<std::string, std::string>;

struct ParameterInfo;

struct ArmModel {
  std::string name;
  ArmParameters<double> nominal;  ///< without the effects
  std::vector<PlacedEffect> effects;
  std::vector<JointDescription> joints;  ///< [n]
  ColumnMap columns;                     ///< empty: halyard's own column names
  std::map<std::string, EstimatorOptions> estimators;
  std::string source;  ///< path, for messages

  int n() const { return nominal.n; }
  Eigen::VectorXd home() const;
  /// Relative tolerance of a number; 0: the model states none.
  double tolerance(const ParameterInfo& number) const;
};

/// Whether two arms have as many joints, of the same types and driven alike: by a motor, or by none.
bool joints_alike(const ArmParameters<double>& a, const ArmParameters<double>& b);

/// One number of the arm that a study may vary and a diagnosis may refit.
struct ParameterInfo {
  std::string name;  ///< "joint 2 cable stiffness"
  std::string key;   ///< "joint2.cable.stiffness", as sweeps name it
  std::string unit;
  int joint;                      ///< 0-based; -1: the arm
  double Tolerances::*tolerance;  ///< which of the joint's tolerances holds for it; null: none
  double* value;                  ///< into the ArmParameters it was listed from
};

/// The numbers of an arm that have a noun in arm_fields.h, joint by joint; of couplings those with inboard joints.
/// Numbers that do not exist at a joint (a cable of a rigid drive) are left out.
std::vector<ParameterInfo> named_parameters(ArmParameters<double>& arm);

}  // namespace halyard
