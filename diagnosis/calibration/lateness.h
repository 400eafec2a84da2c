#pragma once
/// How late the joint sensors of a log are against its motors' encoders, if they are slower. A sensor with a sample
/// rate of its own, such as a camera or a tracker, has its own transport delay, which is a property of the log and not
/// of the arm. Sensors as fast as the motors' encoders share their clock: if one of them is late, the effect `delay`
/// says so.
///
///   e_k = a_k + s_k p_k - d_k p_k' + rest       regression over the samples of joint k
///   d   = Σ_k d_k / σ_k² / Σ_k 1 / σ_k²         one delay for all slow sensors
///
///   e_k   measured minus predicted reading      p_k   reading that the model predicts from the motors
///   d_k   lateness of joint k                   σ_k   its standard deviation, from blocks of time (jackknife)
///   a_k   error of the sensor's zero            s_k   error of the transmission's ratio
///
/// Friction and stretch that are a little off look late, too, by several milliseconds. Therefore the regression only
/// gives a first estimate: the most precise d_k, of the joints in which it explains most of what a and s leave, or 0.
/// The readings are moved by it. Then the model's own numbers are fitted together with zero, ratio and remaining delay
/// of each sensor. The sum is over these delays, of the joints that agree with the median: an effect at one joint
/// disturbs that joint's. d is corrected by the sum until it settles. The result is 0 if these joints are not the
/// majority, if d is below 0.2 ms, or if it is beyond kLongestLateness: a clock so wrong is to be corrected in the log,
/// and check_log() tells it.

#include <optional>

#include "diagnosis/prediction/prediction.h"

namespace halyard {

inline constexpr double kLongestLateness = 0.1;  ///< s, in either direction

/// Lateness d, s; negative: the motors' readings are late. 0 if there are no slow sensors or no common lateness;
/// nothing if the log is too short to tell.
std::optional<double> slow_sensor_lateness(const Log& log, const ArmModel& model);

/// A search that finds a `delay` of all joint sensors, and these are slow, has found what their lateness is off: it was
/// measured while effects were missing. Returns the model with what was found and without this delay, by which the
/// lateness is measured again; nothing if there is no such delay. Events are left out: they belong to one log.
std::optional<ArmModel> model_for_lateness(const std::vector<Log>& logs, const ArmModel& given,
                                           const Hypothesis& found);

}  // namespace halyard
