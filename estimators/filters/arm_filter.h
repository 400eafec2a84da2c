#pragma once
/// A Gaussian filter on an arm: the process model between samples, motor encoders as measurement, and what logs are
/// like: gaps, missing samples, a start at rest.
///
///   start      joints from kinematics, then to static equilibrium under the motors' readings, at rest; a start amid a
///              record takes the speed from two readings, after a gap with the second; samples before all motors have
///              been read once are passed over
///   a step     the time between two samples, cut into equal pieces of at most `max_step`
///   a gap      longer than `restart_gap`: a new start; so are readings that all were refused for as long
///   NaN        torque: the last one is held; position of a motor: no correction from it
///   gate       an innovation that is less probable than 1 - `gate` is not accepted; 1 accepts all

#include <memory>

#include "estimators/filters/gaussian_filter.h"
#include "estimators/process/noise.h"

namespace halyard {

struct ArmFilterOptions {
  NoiseLevels noise;
  double max_step = 0.01;  ///< s
  double restart_gap = 1;  ///< s
  double gate = 1;         ///< probability
  /// Effect states to which the joints have settled when the filter starts: what it does not know of them it does not
  /// know of the joints.
  std::vector<int> settled = {};
};

/// The noise options, max_step, restart_gap and gate.
ArmFilterOptions read_arm_filter_options(OptionReader& options, const ArmModel& model, const ProcessModel& process);

/// What a belief x, S says of the joints.
Estimate joint_estimate(const StateLayout& layout, const Eigen::VectorXd& x, const Eigen::MatrixXd& S);

class ArmFilter final : public Estimator {
 public:
  ArmFilter(const ArmModel& model, std::shared_ptr<const ProcessModel> process, const ArmFilterOptions& options,
            std::unique_ptr<GaussianFilter> filter);

  void reset(const Sample& first) override;
  /// Throws std::invalid_argument if time does not increase.
  Innovation update(const Sample& sample) override;
  Estimate estimate() const override;
  EstimatorReport report() const override;

  /// The belief, for those who look inside.
  const GaussianFilter& filter() const { return *filter_; }

  /// All that the filter knows at an instant, but for commands, of which no past one changes.
  struct Snapshot {
    bool started = false, speed_is_due = false;
    double time_s = 0, refused_since = 0;
    Eigen::VectorXd x, reading, torque, external, adapted;
    Eigen::MatrixXd S;
    EstimatorReport report;
  };
  Snapshot snapshot() const;
  /// Goes back to a snapshot taken since reset(); the samples after it may then be given again.
  void restore(const Snapshot& snapshot);
  /// Predicts to a time and corrects by a measurement that is not the motors'. The filter must have started.
  Innovation correct_at(double time_s, const MeasurementModel& measurement, const Eigen::VectorXd& z,
                        const Eigen::MatrixXd& R_root);

 private:
  void start(const Sample& sample);
  /// S at the start at x, where the joints are at q.
  Eigen::MatrixXd start_root(const Eigen::VectorXd& x, const Eigen::VectorXd& angle, const Eigen::VectorXd& q,
                             double dt_s) const;
  void predict(double to_time_s);
  Innovation correct(const Sample& sample);
  void remember(const Sample& sample);
  double gate_threshold(int m) const;

  ArmModel model_;
  std::shared_ptr<const ProcessModel> process_;
  ArmFilterOptions options_;
  ArmNoise noise_;
  std::unique_ptr<GaussianFilter> filter_;
  std::vector<int> motors_;  // joints that have a motor
  CommandHistory history_;
  double last_command_ = 0;  // its time
  bool started_ = false;
  bool speed_is_due_ = false;  // the start was from one reading that can be trusted
  double time_ = 0;
  double refused_since_ = 0;           // first of the readings refused without one accepted since; infinite: none is
  Eigen::VectorXd reading_;            // last of each motor, NaN before
  Eigen::VectorXd torque_, external_;  // held
  EstimatorReport report_;             // repaired factors: up to where the filter's count was repaired_before_
  long repaired_before_ = 0;
};

}  // namespace halyard
