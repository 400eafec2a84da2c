#include "well_formed.h"

static int estimate_negative(void* instance, halyard_estimate* out, char* message, size_t message_size) {
  estimate(instance, out, message, message_size);
  out->joint_position_std[0] = -1e-3;
  return HALYARD_OK;
}

const halyard_estimator_table* halyard_estimator(void) {
  table.estimate = estimate_negative;
  return &table;
}
