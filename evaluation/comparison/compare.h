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

/// Whether an estimator is as good as it says.
struct Judgement {
  Consistency nis;                   ///< of all motors together
  std::vector<Consistency> nees;     ///< [joint]; NaN where the truth is not known
  std::vector<Whiteness> whiteness;  ///< [motor]
};

/// Estimators head-to-head on the same data.
struct Comparison {
  std::string data;              ///< scenario or log, as given
  std::string model;             ///< what the estimators believe, as given
  std::string truth_from;        ///< what the errors are counted against; empty: nothing, no errors
  double skip_s = 0;             ///< errors count from this time after the first sample on
  std::vector<JointUnit> units;  ///< [n]
  Log truth;                     ///< joint_position, where known
  std::vector<EstimatorRun> runs;
  /// [run][joint] what is held against the truth: positions, or sensors' readings of them
  std::vector<Signals> compared;
  std::vector<std::vector<ErrorStatistics>> errors;           ///< [run][joint]
  std::vector<Judgement> judgements;                          ///< [run]
  std::vector<std::vector<std::vector<PairedRatio>>> paired;  ///< [run][other run][joint] RMS error over the other's

  int n_joints() const { return static_cast<int>(units.size()); }
  bool has_truth(int k) const { return truth.has_joint_position(k); }
  /// Index of the run named "kinematics", which the others are measured by, if there is one.
  std::optional<std::size_t> baseline() const;
  /// 1 - mean absolute error / that of the baseline; NaN without one.
  double improvement_of(std::size_t run, int k) const;
};

struct CompareOptions {
  double skip_s = 0.5;
  bool use_joint_torque = false;
  /// The truth is what joint sensors read, with the errors that the model says they make; otherwise the joints' own.
  bool truth_is_sensed = false;
  /// An estimator that fails leaves a row without numbers; otherwise its failure is thrown.
  bool keep_going = false;
  /// All estimators are made before the first runs: a wrong name must not cost the time of the others' runs.
  bool make_all_first = true;
  ContainmentOptions containment = {};
  std::function<void(double)> progress = {};  ///< called with the fraction done
};

/// An estimator, what it believes, and what its row is called.
struct Contestant {
  std::string estimator;  ///< name or path of a plug-in
  const ArmModel* model = nullptr;
  std::string name;
};

/// Runs each estimator over `measured` and counts its errors against the joint positions of `truth`, which has the same
/// times. Each runs in a process of its own. The strings of the result are the caller's to fill.
/// Throws what make_estimator and run_estimator throw, std::invalid_argument if the times differ.
Comparison compare_estimators(const std::vector<Contestant>& contestants, const Log& measured, const Log& truth,
                              const CompareOptions& options = {});
/// The same with one model for all, and each called as the estimator is.
Comparison compare_estimators(const ArmModel& model, const std::vector<std::string>& estimators, const Log& measured,
                              const Log& truth, const CompareOptions& options = {});

}  // namespace halyard
