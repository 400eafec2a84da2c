#include <math.h>

#include "well_formed.h"

/* Good at first; not a number from the third sample on. */
static int estimate_nan(void* instance, halyard_estimate* out, char* message, size_t message_size) {
  const state* self = instance;
  estimate(instance, out, message, message_size);
  if (self->steps >= 3) out->joint_velocity[self->n - 1] = NAN;
  return HALYARD_OK;
}

const halyard_estimator_table* halyard_estimator(void) {
  table.estimate = estimate_nan;
  return &table;
}
