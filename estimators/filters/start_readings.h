#pragma once
/// The motors' readings from which a filter starts, and those of the start before, which together give the arm's speed.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "estimators/estimator.h"
#include "model/arm_model.h"

namespace halyard {

/// Mean rates over the time between two readings of every motor.
struct MeanRates {
  double shortest_s = 0, longest_s = 0;  ///< of the motors' times
  Eigen::VectorXd motor, joint;          ///< [n]
};

class StartReadings {
 public:
  StartReadings() = default;
  /// motors: the joints that have one, of n.
  StartReadings(std::vector<int> motors, int n);

  /// Keeps what the sample reads.
  void take(const Sample& sample);
  /// Forgets the readings, but not those of the last start.
  void forget();
  /// A filter starts from the readings.
  void start();

  /// Whether every motor has been read.
  bool are_complete() const;
  /// Whether every motor has a reading after that of the last start, with this sample.
  bool are_new(const Sample& sample) const;
  /// Age of the oldest reading, s; 0 without motors.
  double age(double time_s) const;
  /// [n], rad; 0 at joints without a motor
  Eigen::VectorXd angles() const;

  /// The rates since the last start, of an arm whose motors are now at these angles. Call if every motor has a new
  /// reading. The joints' paths are linear in the motors' rates, so all motors are taken to have moved for the longest
  /// time. Nothing if a joint would cross its range within 0.05 s: one of the readings is wrong.
  std::optional<MeanRates> rates(const ArmParameters<double>& arm, const ArmModel& model,
                                 const Eigen::VectorXd& angles) const;

 private:
  double since_start(int motor) const { return read_at_(motor) - started_at_(motor); }

  std::vector<int> motors_;
  Eigen::VectorXd reading_, read_at_;          // NaN: none
  Eigen::VectorXd started_from_, started_at_;  // the same at the last start
};

}  // namespace halyard
