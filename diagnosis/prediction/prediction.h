#pragma once
/// Predictions of a record by hypotheses about an arm, many at a time.

#include <functional>
#include <vector>

#include "diagnosis/record/record.h"

namespace halyard {

/// A hypothesis about an arm: its parameters, its effects, and the effects' states at the start of each record.
struct Hypothesis {
  ArmParameters<double> nominal;
  std::vector<PlacedEffect> effects;
  /// Effects' internal states at a record's start, minus those of an arm that was just lowered onto its cables:
  /// [effect][record's place * n_states + state]; missing entries are 0.
  std::vector<std::vector<double>> past = {};

  double past_state(std::size_t effect, std::size_t i) const;
  void set_past_state(std::size_t effect, std::size_t i, double value);
};

/// The hypothesis without the effect at that index.
Hypothesis without_effect(Hypothesis h, std::size_t place);

/// Residuals of one record under one hypothesis, every stride-th sample: [2n][ceil(size / stride)].
/// Channel k < n: torque residual of motor k, ε / κ, N m. The division by κ converts it to the unit of the measured
/// torque; κ is the ratio of the standard deviation of the acting torque to that of the commanded torque. Channel n +
/// k: measured minus predicted reading of joint k, rad | m. Its mean is subtracted if the zero of one of the joint's
/// encoders is unknown. NaN where the sample cannot be compared; empty if the record has no such signal.
struct Residuals {
  std::vector<std::vector<double>> channel;
  bool finite = true;  ///< false: the motion of this hypothesis cannot be integrated
};

class RecentResiduals;

/// Hypotheses about a record that are integrated with the same steps, so that their residuals can be compared.
struct PredictionRequest {
  const Record* record;
  const std::vector<Hypothesis>* hypotheses;
  int stride;
  RecentResiduals* recent = nullptr;  ///< what is in it is not predicted again; the same for requests about one record
};

/// Residuals of each hypothesis of each request. They depend neither on the other requests nor on the number of
/// threads. Inside run_side_by_side() (side_by_side.h) the requests of all jobs share lanes.
std::vector<std::vector<Residuals>> predict(const std::vector<PredictionRequest>& requests);
std::vector<Residuals> predict(const Record& record, const std::vector<Hypothesis>& hypotheses, int stride);
/// Without waiting for other jobs.
std::vector<std::vector<Residuals>> predict_at_once(const std::vector<PredictionRequest>& requests);

/// Joint readings predicted at every sample, [n][size], and the torque residuals, for reports.
struct FullPrediction {
  Signals joint_reading, torque_residual;
};
FullPrediction predict_fully(const Record& record, const Hypothesis& hypothesis);

}  // namespace halyard
