#pragma once
/// Arms of one structure that differ in some parameters, computed in parallel lanes: column i belongs to member i.
///
///   X_i = f(X_i, θ_i)        z_i = h(X_i, θ_i) = [motor encoders; joint encoders]
///
///   θ_i    parameters of member i, in the order of the keys   [keys]
///   z      rad; rad | m; 0 for a joint without a motor        [2n x members]
///
/// f and h are those of process_model.h; h is extended by the readings of the joint encoders.

#include <deque>
#include <string>
#include <vector>

#include "estimators/process/process_model.h"

namespace halyard {

class ArmFamily {
 public:
  /// keys: from named_parameters(), or "jointK.motor.zero", the motor encoder's offset in rad.
  /// Throws std::invalid_argument for an unknown key.
  ArmFamily(const ArmModel& model, const ProcessModel& structure, const std::vector<std::string>& keys, int members);

  int members() const { return static_cast<int>(arms_.size()); }
  /// θ [keys x members].
  void set(const Eigen::MatrixXd& theta);

  /// X [n_states x members] becomes f(X). With one member, X may have any number of columns, all of that member.
  /// Throws std::runtime_error with time and state name if a result is not finite.
  void advance(const Step& step, int substeps, Eigen::Ref<Eigen::MatrixXd> X) const;
  /// h(X) [2n x members]. lagged: for joint sensors that lag.
  Eigen::MatrixXd readings(double time_s, const Eigen::MatrixXd& X, const LaggedRates& lagged = {}) const;
  /// h of member 0 at x [2n], and H = ∂h/∂x [2n x n_states].
  Eigen::VectorXd readings(double time_s, const Eigen::VectorXd& x, Eigen::MatrixXd& H,
                           const LaggedRates& lagged = {}) const;

 private:
  const ProcessModel& structure_;
  std::deque<ArmParameters<double>> arms_;     // a deque: value_ points into them
  std::vector<std::vector<ArmNumber>> value_;  // [member][key]
  std::vector<Transmission<Lanes>> lanes_;     // eight members each
};

/// The parameter of the arm with this key, as above. Throws std::invalid_argument for an unknown key.
ArmNumber find_number(ArmParameters<double>& arm, const std::string& key);

}  // namespace halyard
