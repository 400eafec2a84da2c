#include "crash.h"
#include "well_formed.h"

/* It cannot even be asked for its name. */
const halyard_estimator_table* halyard_estimator(void) {
  crash();
  return &table;
}
