#include "well_formed.h"

const halyard_estimator_table* halyard_estimator(void) { return &table; }
