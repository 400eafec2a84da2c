#pragma once
/// Closes the loop: from a model and measured logs to what the model lacks, and the model with it.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

struct DiagnosisOptions {
  int most_effects = 6;          ///< that are added to the model
  double significance = 0.01;    ///< of a round of the search: the expected share of chance among what it adds
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

/// How the diagnosis came to its result, for reports: diagnosis_details.h, which is not installed.
struct DiagnosisDetails;

struct Diagnosis {
  enum class Verdict { clean, effects, unknown } verdict = Verdict::clean;
  std::vector<NamedEffect> effects;
  std::vector<Estimated> refitted;
  std::vector<Unexplained> unexplained;
  std::vector<NotExcited> not_excited;
  ArmModel given;  ///< the model as given, its unknown torque scales calibrated
  ArmModel revised;
  std::string holdout;            ///< what the errors were measured on
  PredictionError before, after;  ///< on the hold-out, by `given` and by `revised`
  std::shared_ptr<const DiagnosisDetails> details;
};

/// Diagnoses a model by training logs. The hold-out decides nothing: it only tells the errors. Without one the last
/// third of each training log is held out. progress(what, fraction of it) is called one at a time.
/// Throws InputError for logs that cannot be compared with the model.
Diagnosis diagnose(const ArmModel& model, const std::vector<Log>& training, const std::optional<Log>& holdout,
                   const DiagnosisOptions& options = {},
                   const std::function<void(const std::string&, double)>& progress = {});

}  // namespace halyard
