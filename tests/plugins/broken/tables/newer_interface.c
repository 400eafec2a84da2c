#include "well_formed.h"

const halyard_estimator_table* halyard_estimator(void) {
  table.interface_version = HALYARD_ESTIMATOR_INTERFACE + 1;
  return &table;
}
