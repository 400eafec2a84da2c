#pragma once
/// From what the lanes of a drive wrote to the residuals of each hypothesis.

#include <vector>

#include "diagnosis/prediction/prediction.h"
#include "transmission/scalar.h"

namespace halyard {

/// Whose residuals a lane holds.
struct LaneOwner {
  const Hypothesis* hypothesis;
  Residuals* residuals;
};

/// Fills the residuals of the owners of the first lanes, every stride-th sample. out: as LaneDrive writes it.
void take_residuals(const Record& record, const CommandHistory& history, int stride, const std::vector<Lanes>& out,
                    const std::vector<LaneOwner>& owners);

/// Those of a hypothesis that cannot be integrated: NaN throughout.
Residuals unknown_residuals(const Record& record, int stride);

}  // namespace halyard
