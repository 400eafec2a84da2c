#include <math.h>

#include "well_formed.h"

static const char* name_of(void* instance, size_t i) {
  (void)instance;
  return i == 0 ? "gain" : NULL;
}

static int estimate_gain(void* instance, halyard_estimate* out, char* message, size_t message_size) {
  out->extra_outputs[1] = -INFINITY;
  return estimate(instance, out, message, message_size);
}

const halyard_estimator_table* halyard_estimator(void) {
  table.extra_output_name = name_of;
  table.estimate = estimate_gain;
  return &table;
}
