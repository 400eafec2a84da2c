#pragma once
/// A Gaussian filter on an arm. It predicts with the process model, corrects with the motor encoders, and handles gaps
/// and missing samples of a log.
///
///   start      when every motor has been read once; earlier samples are skipped. Joint positions: kinematics gives a
///              first value, from which the static equilibrium at the motors' readings is computed. A joint without a
///              motor is at home. Speed: zero
///   a step     the time between two samples, cut into equal pieces of at most `max_step`, and into halves and quarters
///              where the exponential step's guard refuses it
///   restart    after a gap longer than `restart_gap`, or if the gate has rejected all readings for that long, not
///              counting samples without readings: when every motor has been read since then. Until then the joints
///              rest where they were, uncertain by their ranges. Speed: from two readings of each motor, those of the
///              start and the next ones; within `max_step` a reading waits until all motors have one. The standard
///              deviation of a speed is the joint's range per second until the second reading, and stays so if the two
///              readings are farther apart than `max_step`. A reading that is older than the start is uncertain by this
///              speed, too. The speed of a joint without a motor stays as uncertain; such a joint starts again where it
///              was
///   NaN        torque: the last one is held, as it is in a gap, and becomes uncertain (held_torques.h); position of a
///              motor: no correction from it
///   gate       an innovation that is less probable than 1 - `gate` is not accepted; 1 accepts all

#include <memory>

#include "estimators/filters/gaussian_filter.h"
#include "estimators/filters/start_readings.h"
#include "estimators/process/noise.h"
#include "estimators/recycling_queue.h"

namespace halyard {

struct ArmFilterOptions {
  NoiseLevels noise;
  double max_step = 0.01;   ///< s
  double restart_gap = 1;   ///< s
  double gate = 1;          ///< probability
  bool exponential = true;  ///< take the exponential step where its guard accepts it; false: always sub-steps
  /// Effect states that shift the joints' equilibrium at the start: their uncertainty adds to that of the joints.
  std::vector<int> settled = {};
  bool in_motion = false;  ///< the speed at the start of a record is uncertain, too
};

/// Reads the noise options, max_step, restart_gap and gate.
ArmFilterOptions read_arm_filter_options(OptionReader& options, const ArmModel& model, const ProcessModel& process);

/// The joints' part of a belief x, S, into memory of the caller.
void set_joint_estimate(const StateLayout& layout, const Eigen::VectorXd& x, const Eigen::Ref<const Eigen::MatrixXd>& S,
                        Estimate& e);

class ArmFilter final : public Estimator {
 public:
  ArmFilter(const ArmModel& model, std::shared_ptr<const ProcessModel> process, const ArmFilterOptions& options,
            std::unique_ptr<GaussianFilter> filter);

  void reset(const Sample& first) override;
  /// Throws std::invalid_argument if time does not increase.
  Innovation update(const Sample& sample) override;
  Estimate estimate() const override;
  EstimatorReport report() const override;

  /// The filter that holds the belief x, S.
  const GaussianFilter& filter() const { return *filter_; }

  /// What the filter keeps from sample to sample, beside its belief, the noise's adaptation and the command history.
  struct Track {
    bool begun = false;         ///< has started once since reset()
    bool started = false;       ///< and no restart is due
    bool speed_is_due = false;  ///< a restart had one reading of each motor: the next ones give the speed
    double time_s = 0;          ///< of the last sample
    double start_time = 0;      ///< of the last start, s
    double refused_since = 0;   ///< time from which the gate has rejected all readings, s; infinite: accepted
    StartReadings readings;
    Eigen::VectorXd judged_at;         ///< time of each motor's last innovation, or of the start, s
    Eigen::VectorXd torque, external;  ///< held
    HeldTorques held;
    EstimatorReport report;  ///< without the factors repaired since reset(), which report() adds
  };
  /// The filter's whole state at an instant, except the command history: past commands do not change.
  struct Snapshot {
    Track track;
    Eigen::VectorXd x, adapted;
    Eigen::MatrixXd S;
    ExponentialStep::Kept kept;
  };
  void save(Snapshot& snapshot) const;
  /// Goes back to a snapshot taken since reset(). Samples after the snapshot may then be repeated; what was
  /// repaired in them stays counted.
  void restore(const Snapshot& snapshot);
  /// Corrects with a measurement other than the motors'. The filter must have started.
  Innovation correct_with(const MeasurementModel& measurement, const ReadingVector& z, const ReadingMatrix& R_root);

  using Predictions = RecyclingQueue<LinearPrediction>;
  /// From now on, update() appends what its predictions were. The queue must outlive the filter.
  void record_into(Predictions& predictions) { predictions_ = &predictions; }
  /// Repeats the update() of a sample that recorded `count` predictions, `first` and those after it, by these linear
  /// maps.
  void repeat(const Sample& sample, const Predictions& predictions, std::size_t first, std::size_t count);

 private:
  /// Where joints without a motor start, [n]: at home, or where they were before a restart. Others: home.
  Eigen::VectorXd undriven_positions() const;
  /// Starts if all motors have been read, not long ago.
  void start(const Sample& sample);
  void set_rates(const MeanRates& rates, Eigen::VectorXd& x) const;
  /// S of the first belief. Its mean is x, in which the joint positions are q.
  Eigen::MatrixXd start_root(const Eigen::VectorXd& x, const Eigen::VectorXd& angle, const Eigen::VectorXd& q,
                             double dt_s) const;
  /// Joints may be wrong by this share of their ranges, and motors with them: positions, whose index is the first, or
  /// rates.
  void widen(double share, int first, Eigen::MatrixXd& S) const;
  /// The same for joints without a motor alone. No motor moves with them; joints further out do, on their cables.
  void widen_undriven(double share, int first, Eigen::MatrixXd& S) const;
  /// Whether the gate has refused for too long what this sample has again.
  bool is_locked_out(const Sample& sample) const;
  /// A restart is due: sets what is known until then.
  void lose_track();
  void predict(double to_time_s);
  /// One step; in halves if the exponential step refuses it, `halvings` times at most, then by the sub-steps.
  void predict_over(Step step, int halvings);
  /// Corrects with the motors' readings, if it need not wait for more of them.
  Innovation take(const Sample& sample);
  Innovation correct(const Sample& sample);
  void remember(const Sample& sample);
  double gate_threshold(int m) const;

  ArmModel model_;
  std::shared_ptr<const ProcessModel> process_;
  ArmFilterOptions options_;
  ArmNoise noise_;
  ExponentialStep exponential_;
  std::unique_ptr<GaussianFilter> filter_;
  std::vector<int> motors_;  // joints that have a motor
  std::vector<int> read_;    // those with a reading in this sample
  CommandHistory history_;
  double last_command_ = 0;  // time of the newest command in history_, s
  Track track_;
  long repaired_before_ = 0;  // filter_->repaired() at the last reset()
  Predictions* predictions_ = nullptr;
  Eigen::VectorXd x_0_;  // before a prediction that is recorded
};

}  // namespace halyard
