#include "well_formed.h"

static int estimate_half(void* instance, halyard_estimate* out, char* message, size_t message_size) {
  const state* self = instance;
  (void)message, (void)message_size;
  memcpy(out->joint_position, self->position, self->n * sizeof(double));
  memset(out->joint_velocity, 0, self->n * sizeof(double));
  return HALYARD_OK;
}

const halyard_estimator_table* halyard_estimator(void) {
  table.estimate = estimate_half;
  return &table;
}
