#pragma once
/// A filter that a camera corrects, which sees a marker at the tool, late and now and then:
///
///   z = p(q(t - L)) + v,  v ~ N(0, σ_c² I)             p: the marker's position by forward kinematics, base frame m
///
///   L     `camera_latency`, exposure to arrival: a sample's marker was there L before the sample's time           s
///   σ_c   `camera_noise`, of each axis                                                                           m
///
/// The marker is where the model's payload hangs. The cables' equilibrium pulls joints back to where motors say they
/// are within milliseconds: corrected alone, the joints would forget between two frames what the camera said. So the
/// state is augmented by what the motors cannot tell, an offset b_k of each cable's stretch,
///
///   x_k = r_m q_m / N - R_k q - b_k,   b' = w_b,   w_b ~ N(0, ρ² δ(t)),   b(0) ~ N(0, σ_b²)
///
///   ρ     how far it wanders: `offset_wander`                                                                     m/√s
///   σ_b   how large it may be at the start: `offset_start`                                                        m
///
/// Both are 1 % of the cable's travel over the joint's range unless told. The joints have unknown forces besides, those
/// of disturbance_filter.h: otherwise whatever the model lacks of a force would be told as an offset by which gravity
/// pulls more or less. A frame is taken where it belongs: the filter goes back to the last sample before its exposure,
/// predicts to it, is corrected, and takes the samples since then anew. A frame that was exposed within a gap after
/// which the filter started anew is not taken.
///
/// Besides the joints' motion it estimates cable_offset and cable_offset_std: b and its standard deviation, m.
///
/// Source: delayed measurements by recalculation: Larsen, Andersen, Ravn, Poulsen, "Incorporation of time delayed
/// measurements in a discrete-time Kalman filter", CDC 1998.

#include <deque>

#include "estimators/filters/unknown_constant.h"

namespace halyard {

struct CameraOptions {
  double latency_s = 0.05;
  double noise_m = 5e-4;
  UnknownLevels offset;
};

/// Those above, by options.
CameraOptions read_camera_options(OptionReader& options, const ArmModel& model);

/// The model with an unknown offset of the stretch of each cable, as its last effects.
ArmModel with_unknown_offsets(const ArmModel& model, const CameraOptions& camera);

class CameraFilter final : public Estimator {
 public:
  /// augmented: of with_unknown_offsets, and process of it; options know of the unknown forces if it has such.
  CameraFilter(const ArmModel& augmented, std::shared_ptr<const ProcessModel> process, ArmFilterOptions options,
               const CameraOptions& camera, std::unique_ptr<GaussianFilter> filter);

  void reset(const Sample& first) override;
  /// The innovation is that of the motors before the sample's marker is taken.
  Innovation update(const Sample& sample) override;
  Estimate estimate() const override;
  std::vector<std::string> extra_output_names() const override { return {"cable_offset", "cable_offset_std"}; }
  EstimatorReport report() const override { return filter_.report(); }

 private:
  struct Past {
    Sample sample;
    ArmFilter::Snapshot after;
  };

  void remember(const Sample& sample);
  void take_marker(const Sample& sample);

  std::shared_ptr<const ProcessModel> process_;
  CameraOptions camera_;
  double restart_gap_;
  ArmFilter filter_;
  std::deque<Past> past_;  // from the last sample before the oldest exposure that can still arrive
};

}  // namespace halyard
