#pragma once
/// Data that no fit and no search uses: a log of its own, or the last third of each training log. A model is adopted
/// only if it does not predict these data worse than the model as given.

#include <optional>

#include "diagnosis/diagnose.h"
#include "diagnosis/fit/evidence.h"

namespace halyard {

/// Frequency band of fits and of reported torque errors. In this band the second derivative of a rounded angle is still
/// meaningful.
inline constexpr RecordOptions kFitBand = {};
/// Frequency band of reported joint errors. It includes the vibrations of the cables.
inline constexpr RecordOptions kJointErrorBand = {.motion_hz = 100, .compare_hz = 0, .settle_s = 0.5, .step_s = 0.001};

/// Share of a training log that is not held out, if there is no hold-out log.
inline constexpr double kTrainingShare = 2.0 / 3;

/// Records of the hold-out, and their predictions by the given (before) and the revised model (after).
struct HoldOut {
  std::vector<Record> records;
  std::vector<FullPrediction> before, after;
  /// 95 % intervals of the joint readings in `after`, see prediction_interval.h: [record], each [n][size].
  std::vector<Signals> half_width = {};
};

/// The logs of a diagnosis as records.
struct DiagnosisData {
  std::vector<Record> training;
  std::vector<Record> training_joints;  ///< the training data in kJointErrorBand
  HoldOut joint_view;                   ///< in kJointErrorBand
  HoldOut torque_view;                  ///< in kFitBand
  /// Lateness of slow joint sensors that was taken out of a log's records, see lateness.h.
  struct Late {
    std::string log;
    double seconds;
  };
  std::vector<Late> late;  ///< only logs with a lateness
};

/// Without a hold-out log, the last third of each training log is held out. Cables have memory, so the part of the log
/// before that third is predicted as well, but not compared. tells_lateness: the model by which the lateness of slow
/// sensors is measured.
/// Throws InputError as make_records() does, and if gaps leave less than 0.7 s of the last thirds to compare.
DiagnosisData diagnosis_data(const ArmModel& model, const std::vector<Log>& training, const std::optional<Log>& holdout,
                             const ArmModel& tells_lateness);

/// Measured minus predicted at sample i of joint k; NaN where nothing is compared.
double joint_error(const Record& r, const FullPrediction& p, int k, std::size_t i);
double torque_error(const Record& r, const FullPrediction& p, int k, std::size_t i);

/// Errors of both views with one of their predictions, HoldOut::before or HoldOut::after. A sample of a joint or of its
/// torque is resting if the joint's motor rests there, see resting.h.
PredictionError prediction_errors(const HoldOut& joints, const HoldOut& torques, const ArmParameters<double>& arm,
                                  std::vector<FullPrediction> HoldOut::*which);

/// Predictions of all records.
std::vector<FullPrediction> predict_all(const std::vector<Record>& records, const Hypothesis& hypothesis);

/// [2n] The floor of each channel on the hold-out. It is the evidence's floor, except for a channel that no training
/// data show: nothing was fitted to it, so the model's numbers are wrong there by as much as their tolerances allow. A
/// change of the model that is right elsewhere may add to this error by chance, but by less than the error itself.
///
///   floor² = mean over samples of Σ_p (∂r/∂θ_p · tolerance_p)²        r: residual, θ_p: numbers of the model
std::vector<double> holdout_floors(const Evidence& evidence, const ArmModel& model, const HoldOut& joints,
                                   const HoldOut& torques);

/// Squares of the errors of one prediction of both views, in squared floors [2n]. Channels without a floor and torques
/// of motors at rest do not count.
double error_over_floors(const ArmModel& model, const HoldOut& joints, const HoldOut& torques,
                         std::vector<FullPrediction> HoldOut::*which, const std::vector<double>& floor);

/// 0-based joints of which `after` predicts the position or the torque worse than `before`. Worse means that the mean
/// square grows significantly, by a paired t test over seconds, and by at least a fortieth and one squared floor [2n],
/// see holdout_floors(). Torques of motors at rest do not count.
std::vector<int> worse_joints(const ArmModel& model, const HoldOut& joints, const HoldOut& torques,
                              const std::vector<double>& floor);

}  // namespace halyard
