#pragma once
/// What hypotheses about an arm predict of a record, many at a time.

#include <functional>
#include <vector>

#include "diagnosis/record.h"

namespace halyard {

/// An arm as it may be: numbers and effects, and what the effects went through before each record.
struct Hypothesis {
  ArmParameters<double> nominal;
  std::vector<PlacedEffect> effects;
  /// What the effects' internal states have at a record's start beyond those of an arm that was just let down onto its
  /// cables, [effect][record's place * n_states + state]; what is missing is 0.
  std::vector<std::vector<double>> past = {};

  double past_state(std::size_t effect, std::size_t i) const;
  void set_past_state(std::size_t effect, std::size_t i, double value);
};

/// Without the effect at that place.
Hypothesis without_effect(Hypothesis h, std::size_t place);

/// Residuals of one record under one hypothesis, every stride-th sample: [2n][ceil(size / stride)].
/// Channel k < n: torque residual of motor k, N m. Channel n + k: measured minus predicted reading of
/// joint k, rad | m; less its mean if the zero of one of the joint's encoders is unknown. NaN where the record has no
/// such signal or the sample cannot be compared.
struct Residuals {
  std::vector<std::vector<double>> channel;
  bool finite = true;  ///< false: the hypothesis is so far off that its motion cannot be integrated
};

/// Residuals of each hypothesis over a record. All hypotheses must have the same effects at the same
/// joints; only numbers differ. Deterministic, whatever the number of threads.
std::vector<Residuals> predict(const Record& record, const std::vector<Hypothesis>& hypotheses, int stride);

/// Joint readings predicted at every sample, [n][size], beside the torque residuals: for the report.
struct FullPrediction {
  Signals joint_reading, torque_residual;
};
FullPrediction predict_fully(const Record& record, const Hypothesis& hypothesis);

}  // namespace halyard
