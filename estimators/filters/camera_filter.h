#pragma once
/// A filter that is also corrected by a camera, which sees a marker at the tool with a delay and in some samples only:
///
///   z = p(q(t - L)) + v,  v ~ N(0, σ_c² I)             p: the marker's position by forward kinematics,
///                                                     in the base frame, m
///
///   L     `camera_latency`, from exposure to arrival: a marker was seen L before its sample's time               s
///   σ_c   `camera_noise`, of each axis                                                                           m
///
/// The marker is at the point of the model's payload. Within milliseconds the cables pull the joints back to the
/// equilibrium that the motor angles imply. A correction of the joints alone would be lost before the next frame. So
/// the state is augmented by an offset b_k of each cable's stretch, which the motors cannot observe:
///
///   x_k = r_m q_m / N - R_k q - b_k,   b' = w_b,   w_b ~ N(0, ρ² δ(t)),   b(0) ~ N(0, σ_b²)
///
///   ρ     intensity of its random walk: `offset_wander`                                                           m/√s
///   σ_b   standard deviation at the start: `offset_start`                                                         m
///
/// Both default to 1 % of the cable's travel over the joint's range. The joints also have the unknown forces of
/// disturbance_filter.h: without them a force that the model lacks would appear as an offset.
///
/// A frame corrects the state at the last sample before its exposure, from which the joints move on at their speeds for
/// the less than a sample that is left: p(q + (t - L - t_0) q'). Then the later samples are repeated. Their predictions
/// are the linear maps which they were the first time (LinearPrediction), because a frame changes the mean by little:
/// so a repetition costs no evaluation of the model. If the filter restarted after the exposure, the frame is ignored.
///
/// Extra outputs are cable_offset and cable_offset_std: b and its standard deviation, m.
///
/// Source: delayed measurements by recalculation: Larsen, Andersen, Ravn, Poulsen, "Incorporation of time delayed
/// measurements in a discrete-time Kalman filter", CDC 1998.

#include "estimators/filters/unknown_constant.h"
#include "estimators/recycling_queue.h"

namespace halyard {

struct CameraOptions {
  double latency_s = 0.05;
  double noise_m = 5e-4;
  UnknownLevels offset;
};

/// Reads the options above.
CameraOptions read_camera_options(OptionReader& options, const ArmModel& model);

/// The model with one more effect for each cable: an unknown offset of its stretch. These effects are the last of the
/// model.
ArmModel with_unknown_offsets(const ArmModel& model, const CameraOptions& camera);

class CameraFilter final : public Estimator {
 public:
  /// `augmented` is a model from with_unknown_offsets(), and `process` is its process model. If `augmented` also has
  /// unknown forces, `options` must come from with_force_wander().
  CameraFilter(const ArmModel& augmented, std::shared_ptr<const ProcessModel> process, ArmFilterOptions options,
               const CameraOptions& camera, std::unique_ptr<GaussianFilter> filter);

  void reset(const Sample& first) override;
  /// Returns the innovation of the motors, computed before the correction with the sample's marker.
  Innovation update(const Sample& sample) override;
  Estimate estimate() const override;
  std::vector<std::string> extra_output_names() const override { return {"cable_offset", "cable_offset_std"}; }
  EstimatorReport report() const override { return filter_.report(); }

 private:
  struct Past {
    Sample sample;
    ArmFilter::Snapshot after;
    std::size_t predictions;  ///< that led to it from the sample before; 0: a start
  };

  void remember(const Sample& sample, std::size_t predictions);
  void take_marker(const Sample& sample);

  std::shared_ptr<const ProcessModel> process_;
  CameraOptions camera_;
  ArmFilter filter_;
  // Starts at the last sample before the exposure of the oldest frame that can still arrive.
  RecyclingQueue<Past> past_;
  ArmFilter::Predictions predictions_;  // of all samples in past_ but the first
};

}  // namespace halyard
