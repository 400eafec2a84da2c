#pragma once
/// A cable-driven serial arm as a model file describes it: the parameters of the equations, effects, controller, column
/// map for foreign logs, and options of estimators.

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "model/column_map.h"
#include "model/tolerances.h"
#include "transmission/effect.h"

namespace halyard {

/// PD control of one motor at the motor shaft: τ = kp e + kd ė, |τ| <= limit, with e = q_m,d - q_m and the backward
/// difference ė of plant/controller.h.
struct ControllerParameters {
  double kp = 0;            ///< N m/rad
  double kd = 0;            ///< N m s/rad
  double torque_limit = 0;  ///< N m; 0: none

  /// False if the joint follows no trajectory.
  bool acts() const { return kp > 0 || kd > 0; }
};

/// Description of a joint, apart from the parameters of its equations.
struct JointDescription {
  std::string name;
  double lower = 0, upper = 0;  ///< range, rad | m
  double home = 0;              ///< runs start here by default; assumed where a log gives no position, rad | m
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
  /// Largest expected deviation of a parameter from this model's value, in its unit; 0: the model states none.
  double reach(const ParameterInfo& number) const;
};

/// Whether two arms have the same number of joints, with the same types, and motors at the same joints.
bool joints_alike(const ArmParameters<double>& a, const ArmParameters<double>& b);

/// The parameters of a model's arm with the changes that its effects make to them.
ArmParameters<double> arm_with_effects(const ArmModel& model);

/// A number of a model that may be changed.
class ArmNumber {
 public:
  /// in_proportion: other numbers, which keep their ratio to this one.
  explicit ArmNumber(double& number, std::vector<double*> in_proportion = {})
      : number_(&number), in_proportion_(std::move(in_proportion)) {}

  double get() const { return *number_; }
  void set(double x) const {
    if (*number_ != 0)
      for (double* other : in_proportion_) *other *= x / *number_;
    *number_ = x;
  }

 private:
  double* number_;
  std::vector<double*> in_proportion_;
};

/// One parameter of the arm that a study may vary and a fit may change.
struct ParameterInfo {
  std::string name;  ///< "joint 2 cable stiffness"
  std::string key;   ///< "joint2.cable.stiffness", as sweeps name it
  std::string unit;
  int joint;                      ///< 0-based
  double Tolerances::*tolerance;  ///< the tolerance that applies to it; null: none
  ArmNumber number;               ///< of the arm given to named_parameters()
  double unit_of_tolerance;       ///< deviation that a tolerance of 1 stands for
  double least;                   ///< nearly 0 if no arm has less than 0 of it; else -infinity
};

/// The parameters for which arm_fields.h gives a noun (a name in words), joint by joint. Centres of mass have an entry
/// for each axis ("joint2.link.com.x"). A link's inertia has one entry ("joint2.link.inertia"), which is its largest
/// moment: the other moments and products stay in proportion to it, because six numbers that are changed one by one may
/// be those of no body. Coupling coefficients are listed only for inboard joints. Parameters that do not exist at a
/// joint are left out, such as cable stiffness at a rigid drive.
std::vector<ParameterInfo> named_parameters(ArmParameters<double>& arm);

/// named_parameters(arm)[index].number, without the names of all others. Throws std::bad_optional_access if there is
/// none.
ArmNumber named_number(ArmParameters<double>& arm, std::size_t index);
/// Its value.
double named_value(const ArmParameters<double>& arm, std::size_t index);

}  // namespace halyard
