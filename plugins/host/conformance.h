#pragma once
/// Conformance tests for estimator plug-ins. Authors call them from their own tests:
///
///   EXPECT_EQ(halyard::conformance_faults("./my_estimator.so", model), std::vector<std::string>());

#include <functional>
#include <string>
#include <vector>

#include "model/arm_model.h"

namespace halyard {

/// Runs the estimator over a synthetic record of 0.2 s. Each joint swings about home by 2 % of its range, the motors
/// follow without cable stretch, and all motor torques are 0. The readings are those of the model's arm, with its
/// encoders' offsets and the changes that its effects make. Returns one line for each promise of estimator.h that the
/// estimator breaks:
///
///   - estimates are finite and repeatable, and asking for one changes nothing
///   - each revision is of a sample that was already given; after each sample, the number of revisions is at most the
///     number of samples given so far
///   - two instances that run in turn do not disturb each other and give the same numbers to the last bit
///   - reset() restarts the estimator; nothing remains of the run before
///   - missing samples (also at the start) and gaps do not stop it; a motor without a sample has no innovation
///   - it works with and without an external load, with and without a marker
///   - it works, over a gap too, with the arm at rest without any one of its motors, unless it has only one; or it
///     refuses that arm (InputError) when it is made
///   - report() counts the samples
///   - an unknown option is refused
///   - standard deviations of estimates are finite and not negative, those of innovations finite and above 0
///
/// Does not test how accurate the estimates are. Throws as make_estimator() does if there is no such estimator. Calls
/// trying(promise) before it tests each promise.
std::vector<std::string> conformance_faults(const std::string& name_or_path, const ArmModel& model,
                                            const std::function<void(const std::string&)>& trying = {});

/// For estimators that are Kalman filters with the noise of noise.h. Compares the estimator with the textbook Kalman
/// filter in covariance form, on an arm with linear equations: one slider on a cable, without gravity and Coulomb
/// friction, pushed back and forth for 0.2 s. Returns one line for each difference. Positions must agree within 1e-9 m,
/// standard deviations within 1e-6 (relative).
std::vector<std::string> kalman_faults(const std::string& name_or_path);

}  // namespace halyard
