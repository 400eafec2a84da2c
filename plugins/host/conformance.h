#pragma once
/// What every estimator has to keep, for the tests of those who write one:
///
///   EXPECT_EQ(halyard::conformance_faults("./my_estimator.so", model), std::vector<std::string>());

#include <functional>
#include <string>
#include <vector>

#include "model/arm_model.h"

namespace halyard {

/// Runs the estimator over a synthetic record of 0.2 s: each joint swings about home by 2 % of its range, the motors
/// follow without stretch, no torque. Returns one line for each promise of estimator.h that it breaks:
///
///   - estimates are finite and repeatable, and asking for one changes nothing
///   - what it revises are estimates of samples, each at most as often as there are samples
///   - two instances fed in turn do not disturb each other and give the same numbers to the last bit
///   - reset() starts anew, with nothing left of the run before
///   - missing samples, at the start too, and gaps do not stop it; a missing motor has no innovation
///   - an external load may be given or not, and so may a marker
///   - report() counts the samples
///   - an unknown option is refused
///   - deviations, and those of innovations, are finite and not negative
///
/// Says nothing of how good the estimates are. Throws what make_estimator throws if there is no such estimator.
/// trying(promise) is called before each promise is put to the test.
std::vector<std::string> conformance_faults(const std::string& name_or_path, const ArmModel& model,
                                            const std::function<void(const std::string&)>& trying = {});

/// For estimators that are Kalman filters with the noise of noise.h: one line for each way in which the estimator
/// differs from the Kalman filter, by textbook and in covariances, on an arm whose equations are linear: one slider on
/// a cable, without gravity and Coulomb friction, pushed to and fro for 0.2 s. Positions within 1e-9 m, deviations
/// within 1e-6.
std::vector<std::string> kalman_faults(const std::string& name_or_path);

}  // namespace halyard
