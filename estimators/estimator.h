#pragma once
/// A state estimator: it estimates the joints' motion from motor signals, and from a camera or a measured load if there
/// is one; never from joint sensors.

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "transmission/arm_parameters.h"

namespace halyard {

/// The largest number of values that are measured at a time: the encoders of motors and joints.
inline constexpr int kMaxReadings = 2 * kMaxJoints;
/// They have their memory in themselves, so that an update takes none from the heap. Their layout does not depend on
/// the compiler's flags.
using ReadingVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor | Eigen::DontAlign, kMaxReadings, 1>;
using ReadingMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor | Eigen::DontAlign,
                                    kMaxReadings, kMaxReadings>;

/// One row of a log, as an estimator sees it.
struct Sample {
  double time_s = 0;
  Eigen::VectorXd motor_torque;    ///< [n] commanded from this time on, N m; NaN: missing, the last one is held
  Eigen::VectorXd motor_position;  ///< [n] measured at this time, rad; NaN: missing, no correction from it
  Eigen::VectorXd joint_torque;    ///< [n] measured external load, N m | N; empty: none
  /// [3] position of the tool's marker as the camera measured it, in the base frame, m; empty: not seen
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor | Eigen::DontAlign, 3, 1> marker = {};
};

/// The difference between a measurement and its prediction, for the m of n motors that were measured.
struct Innovation {
  double time_s = 0;
  ReadingVector nu;      ///< z - ẑ                          [m], rad
  ReadingMatrix S_root;  ///< lower, S_root S_rootᵀ = cov(ν)  [m x m]
  bool accepted = true;  ///< false: gated out, belief unchanged
  double nis() const;    ///< νᵀ S⁻¹ ν ~ χ²(m) if the model is right; 0 if m = 0
};

/// Estimated motion of the joints.
struct Estimate {
  Eigen::VectorXd joint_position;      ///< [n] rad | m
  Eigen::VectorXd joint_velocity;      ///< [n] rad/s | m/s
  Eigen::VectorXd joint_position_std;  ///< [n] one standard deviation; 0 where the estimator has none
  /// Further estimated quantities: one column [n] for each of extra_output_names(); NaN: not estimated for that joint.
  Eigen::MatrixXd extra_outputs = {};
};

/// A revised estimate of an earlier sample, after later samples have improved it.
struct Revision {
  double time_s = 0;  ///< of a sample since reset()
  Estimate estimate;
};

/// Counts of a run.
struct EstimatorReport {
  long steps = 0;
  long repaired_factors = 0;  ///< square-root factors that were lost and rebuilt
  long gated = 0;             ///< measurements not accepted
};

class Estimator {
 public:
  virtual ~Estimator() = default;
  /// Starts at a first sample, at rest.
  virtual void reset(const Sample& first) = 0;
  /// Predicts to the sample's time with the torque of the previous sample, then corrects with this sample's motor
  /// positions. Throws std::runtime_error if the state cannot be kept finite; the message names time and state.
  virtual Innovation update(const Sample& sample) = 0;
  virtual Estimate estimate() const = 0;
  /// Names of the columns of Estimate::extra_outputs, such as "joint_force". The names of an instance do not change.
  virtual std::vector<std::string> extra_output_names() const { return {}; }
  /// Returns a revised estimate of an earlier sample, or none. Call it after reset()
  /// and after each update() until it returns none; `at_end`: no sample follows. A filter never revises.
  virtual std::optional<Revision> revise(bool /*at_end*/) { return std::nullopt; }
  virtual EstimatorReport report() const = 0;
};

}  // namespace halyard
