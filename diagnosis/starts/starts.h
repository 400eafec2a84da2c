#pragma once
/// Start values for the fit of a candidate. Least squares finds only the nearest minimum, so sizes and shapes are first
/// tried over their whole ranges, and then the sizes that a linear fit asks for.

#include <limits>

#include "diagnosis/starts/screen.h"

namespace halyard {

/// First-order changes of the fitting rows by the sizes of one group of a candidate's parameters, at some of its
/// shapes.
struct Directions {
  Hypothesis neutral;                        ///< with the candidate, its last effect, at these shapes and no size
  std::vector<FitParameter> sizes;           ///< of the group
  std::vector<std::vector<double>> columns;  ///< change of the rows by a unit (FitParameter::scale) of each size
  std::size_t numbers = 0;                   ///< sizes and shapes
};

struct Start {
  /// With the candidate, their last effect: the start that leaves least, then the best starts at other shapes. The one
  /// from which a fit ends best need not be the one that leaves least.
  std::vector<Hypothesis> hypotheses;
  double promise = 0;                                     ///< at the best start, see screen.h; 0: it explains nothing
  double left = std::numeric_limits<double>::infinity();  ///< |r⊥ + d⊥|² at the first
  std::vector<Directions> directions;                     ///< at the most promising shapes, the best first
};

/// `with`: the candidate is its last effect. Each size is tried with each start of the shapes that follow it, at its
/// typical value and at the value that the linear fit gives. A size without shapes is also tried over decades; one with
/// shapes also at nine tenths of its range, if the range is not much more than the typical value. A single instant is
/// tried over the record and at the jumps of the residual. At most so many hypotheses as kRule says, each of another
/// law: they differ in more than the past.
Start best_start(const Evidence& evidence, const Screen& screen, const Hypothesis& with,
                 const ArmParameters<double>& nominal);

}  // namespace halyard
