#include "well_formed.h"

int halyard_fixture_defined_nowhere(void);

const halyard_estimator_table* halyard_estimator(void) { return halyard_fixture_defined_nowhere() ? &table : NULL; }
