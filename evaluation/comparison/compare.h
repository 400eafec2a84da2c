#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/joint_unit.h"
#include "evaluation/judgement/consistency.h"
#include "evaluation/judgement/error_statistics.h"
#include "evaluation/run/contained_run.h"
#include "evaluation/run/estimate.h"
#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

/// Tests whether an estimator's errors and innovations agree with the covariances that it states.
struct Judgement {
  Consistency nis;                   ///< of all motors together
  std::vector<Consistency> nees;     ///< [joint]; NaN where the truth is unknown
  std::vector<Whiteness> whiteness;  ///< [motor]
};

/// Estimators compared on the same data.
struct Comparison {
  std::string data;        ///< scenario or log, as given
  std::string model;       ///< the estimators' model, as given
  std::string truth_from;  ///< source of the truth; empty: there is none, and no errors
  /// Of a log: what the check of its columns finds so wrong that the comparison means nothing.
  std::vector<std::string> wrong_columns;
  double skip_s = 0;               ///< duration at the start that is not counted in the errors, s
  bool with_joint_torque = false;  ///< the estimators were given the measured loads on the joints
  bool with_marker = false;        ///< they were given what a camera saw
  std::vector<JointUnit> units;    ///< [n]
  Log truth;                       ///< joint_position, where known
  std::vector<EstimatorRun> runs;
  /// [run][joint] estimates that are compared with the truth: positions, or predicted sensor readings
  std::vector<Signals> compared;
  std::vector<std::vector<ErrorStatistics>> errors;           ///< [run][joint]
  std::vector<Judgement> judgements;                          ///< [run]
  std::vector<std::vector<std::vector<PairedRatio>>> paired;  ///< [run][other run][joint] ratio of RMS errors

  int n_joints() const { return static_cast<int>(units.size()); }
  bool has_truth(int k) const { return truth.has_joint_position(k); }
  /// Index of the run named "kinematics", the baseline of the other runs, if there is one.
  std::optional<std::size_t> baseline() const;
  /// 1 - mean absolute error / that of the baseline; NaN without one.
  double improvement_of(std::size_t run, int k) const;
};

struct CompareOptions {
  double skip_s = 0.5;
  bool use_joint_torque = false;
  /// True: the truth is given by readings of joint sensors, which have the sensor errors that the model states. False:
  /// the truth is given by true joint positions.
  bool truth_is_sensed = false;
  /// True: an estimator that fails or refuses the log leaves a row without numbers. False: its failure is thrown.
  bool keep_going = false;
  /// Make all estimators before the first run, so that a wrong name is found early.
  bool make_all_first = true;
  ContainmentOptions containment = {};
  std::function<void(double)> progress = {};  ///< called with the fraction done
};

/// An estimator, its model, and the name of its row.
struct Contestant {
  std::string estimator;  ///< name or path of a plug-in
  const ArmModel* model = nullptr;
  std::string name;
};

/// Throws InputError if nothing of a record of that duration is left after the skipped time. of: where the duration is
/// told.
void check_skip(double skip_s, double duration_s, const std::string& of);

/// Runs each estimator over `measured`, in a process of its own, and computes its errors against the joint positions of
/// `truth`. Both logs must have the same times. The caller fills data, model, truth_from and wrong_columns of the
/// result. Throws as make_estimator and run_estimator do, and std::invalid_argument if the times differ.
Comparison compare_estimators(const std::vector<Contestant>& contestants, const Log& measured, const Log& truth,
                              const CompareOptions& options = {});
/// The same with one model for all estimators; rows have the estimators' names.
Comparison compare_estimators(const ArmModel& model, const std::vector<std::string>& estimators, const Log& measured,
                              const Log& truth, const CompareOptions& options = {});

}  // namespace halyard
