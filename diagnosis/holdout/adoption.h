#pragma once
/// Whether a revised model is adopted: only if it predicts no joint of the hold-out worse than the given model does
/// (worse_joints()). If it does, numbers are given back and the others fitted again: first those that move the worse
/// joints and that the training hardly determines, then all numbers of the motion (with_given_motion()). If a joint is
/// still worse, it is refused.

#include <cstddef>
#include <vector>

#include "diagnosis/fit/fit.h"
#include "diagnosis/holdout/holdout.h"

namespace halyard {

/// A model that was revised.
struct Revised {
  Fit fit;
  std::vector<std::size_t> changed;  ///< see changed_numbers()
};

struct AdoptionTask {
  const Evidence& evidence;
  const Evidence& whole;      ///< an Evidence without deciding blocks
  const ArmModel& given;      ///< as it was given, with calibrated torque scales
  const ArmModel& tolerated;  ///< the same with the tolerances of the search
  bool has_own_log;           ///< the hold-out is a log of its own, not the last third of the training
};

struct Adoption {
  Revised revised;         ///< as it was tried last
  std::vector<int> worse;  ///< 0-based joints that it predicts worse: it is refused. Empty: it is adopted
  /// Events of the adopted model that did not happen in a hold-out log of its own: indices of its effects, the last
  /// first. An event at an instant of the training says nothing about another log: the log is predicted with it, at the
  /// same time of its own clock, or without it, whichever leaves less error.
  std::vector<std::size_t> absent_events;
};

/// HoldOut::after of both views becomes what is adopted; HoldOut::before has to be there.
Adoption adopted_on_holdout(const AdoptionTask& task, Revised revised, HoldOut& joints, HoldOut& torques);

/// As the hold-out sees a hypothesis: a log of its own has its own clock, the last thirds have those of their logs.
Hypothesis on_holdout_clock(const AdoptionTask& task, const Hypothesis& on_common_clock);

}  // namespace halyard
