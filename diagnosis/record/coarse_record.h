#pragma once
/// A record on a coarser grid, for predictions that need not be as accurate.

#include "diagnosis/record/record.h"

namespace halyard {

/// Every `times`-th sample of a record, from the first on. A sample counts as measured if one of the record's nearest
/// to it does. The filters stay the same: what they leave lies below half of the coarser sample rate, if that is at
/// least four times motion_hz.
Record coarse_record(const Record& record, int times);

}  // namespace halyard
