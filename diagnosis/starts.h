#pragma once
/// Where the fit of a candidate sets out: least squares finds only the nearest valley, so sizes and shapes are first
/// tried over what the candidate may be, and impacts make the residual rough in a size, so they are tried around it
/// again.

#include <limits>

#include "diagnosis/screen.h"

namespace halyard {

struct Start {
  Hypothesis hypothesis;  ///< the candidate, the last effect, where it takes most of the residual
  double promise = 0;     ///< of the best that was tried, see screen.h; 0: it takes nothing
  double left = std::numeric_limits<double>::infinity();  ///< |r⊥ + d⊥|² there
};

/// `with`: the candidate is the last effect. Each of its sizes is tried with each start of the shapes that follow it,
/// at its typical value and at what the linear fit of that asks for; a size without shapes over decades as well. A lone
/// instant is sought over the record and where the residual leaps.
Start best_start(const Evidence& evidence, const Screen& screen, const Hypothesis& with,
                 const ArmParameters<double>& nominal);

/// The best of the hypothesis and its likes with one number of an effect, from place `first` on, somewhat changed: by
/// the sum of squares of the fitting rows, each channel over its scale.
Hypothesis nudged(const Evidence& evidence, Hypothesis h, std::size_t first, const ArmParameters<double>& nominal,
                  const std::vector<double>& scale);

}  // namespace halyard
