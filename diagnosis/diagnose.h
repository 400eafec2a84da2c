#pragma once
/// Closes the loop: from a model and measured logs to what the model lacks, and the model with it.

#include <optional>

#include "diagnosis/attribution.h"

namespace halyard {

struct DiagnosisOptions {
  RecordOptions record;
  /// For the joint errors that are told: the band in which the joints move, vibrations of the cables included. Torques
  /// are told in the band of the fit, where their second derivative of a rounded angle still means something.
  RecordOptions joint_error = {.motion_hz = 100, .compare_hz = 0, .settle_s = 0.5, .step_s = 0.001};
  AttributionOptions attribution;
  bool tell_not_excited = true;  ///< fill Diagnosis::not_excited: a prediction for every candidate
};

/// A number with its unit and 95 % interval.
struct Estimated {
  std::string name, unit;
  double value = 0, lower = 0, upper = 0;
  double nominal = 0;
};

struct NamedEffect {
  PlacedEffect effect;
  std::vector<Estimated> parameters;
  std::vector<PlacedEffect> alternatives;
};

struct Unexplained {
  int joint;              ///< 0-based
  std::string signature;  ///< what the rest looks like
};

struct NotExcited {
  std::string effect;
  int joint;
  std::string why;
};

/// Errors per joint, [n]; NaN where there is no sensor.
struct PredictionError {
  std::vector<double> joint_rms, joint_peak, torque_rms;
};

/// Records of the hold-out and what the given and the revised model predict of them.
struct HoldOut {
  std::vector<Record> records;
  std::vector<FullPrediction> before, after;
};

struct Diagnosis {
  enum class Verdict { clean, effects, unknown } verdict = Verdict::clean;
  std::vector<NamedEffect> effects;
  std::vector<Estimated> refitted;
  std::vector<Unexplained> unexplained;
  std::vector<NotExcited> not_excited;
  ArmModel given;  ///< the model as given, its unknown torque scales calibrated
  ArmModel revised;
  std::vector<std::vector<double>> past;  ///< of the revised model's effects, before each training record: Hypothesis
  std::string holdout;                    ///< what the errors were measured on
  PredictionError before, after;          ///< on the hold-out, by `given` and by `revised`
  Attribution attribution;
  HoldOut joint_view, torque_view;  ///< in the bands of DiagnosisOptions::joint_error and ::record
};

/// Diagnoses a model by training logs. The hold-out decides nothing: it only tells the errors. Without one the last
/// third of each training log is held out.
/// Throws InputError for logs that cannot be compared with the model.
Diagnosis diagnose(const ArmModel& model, const std::vector<Log>& training, const std::optional<Log>& holdout,
                   const DiagnosisOptions& options,
                   const std::function<void(const std::string&, double)>& progress = {});

}  // namespace halyard
