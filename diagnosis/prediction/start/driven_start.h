#pragma once
/// Where a prediction starts, and how fast the driven arm moves there: its eigenvalues decide the steps of the
/// integration (chebyshev.h).

#include "diagnosis/motion/motion_kernel.h"
#include "diagnosis/prediction/prediction.h"

namespace halyard {

/// Joint positions with the motors at u if no cable is stretched, at rest; effects are without a past.
DrivenState<double> unstretched_state(const Hypothesis& h, const Record& record, const DrivenInput& u);

/// Eigenvalues of the driven arm with the motors held: at rest at x, and in motion under the largest load of the
/// record, without and with effects whose states have yielded. Empty if they cannot be computed.
std::vector<Eigenvalues> eigenvalues_of(const Hypothesis& h, const Record& record, const DrivenInput& held,
                                        const DrivenState<double>& x);

}  // namespace halyard
