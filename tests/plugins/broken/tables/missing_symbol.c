#include "well_formed.h"

HALYARD_EXPORT const halyard_estimator_table* halyard_estimater(void) { return &table; }
