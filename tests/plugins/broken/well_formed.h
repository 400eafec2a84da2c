/* An estimator that keeps the contract in plain C, for modules that each break it in one place. It believes that the
 * joint stands where the motor does. */
#include <stdlib.h>
#include <string.h>

#include "plugins/halyard_estimator.h"

typedef struct state {
  size_t n;
  int64_t steps;
  double position[8];
} state;

static int create(const halyard_config* config, void** instance, char* message, size_t message_size) {
  state* self;
  if (config->n_options != 0) {
    strncpy(message, "has no options", message_size);
    return HALYARD_REFUSED;
  }
  self = calloc(1, sizeof *self);
  self->n = config->n_joints;
  *instance = self;
  return HALYARD_OK;
}

static void destroy(void* instance) { free(instance); }

static int reset(void* instance, const halyard_sample* first, char* message, size_t message_size) {
  state* self = instance;
  (void)message, (void)message_size;
  memcpy(self->position, first->motor_position, self->n * sizeof(double));
  self->steps = 0;
  return HALYARD_OK;
}

static int update(void* instance, const halyard_sample* sample, halyard_innovation* innovation, char* message,
                  size_t message_size) {
  state* self = instance;
  size_t i, j;
  (void)message, (void)message_size;
  ++self->steps;
  innovation->m = self->n;
  for (i = 0; i < self->n; ++i) {
    innovation->nu[i] = sample->motor_position[i] - self->position[i];
    for (j = 0; j <= i; ++j) innovation->S_root[i * self->n + j] = (double)(1 + i); /* above, nothing is read */
    self->position[i] = sample->motor_position[i];
  }
  return HALYARD_OK;
}

static int estimate(void* instance, halyard_estimate* out, char* message, size_t message_size) {
  state* self = instance;
  (void)message, (void)message_size;
  memcpy(out->joint_position, self->position, self->n * sizeof(double));
  memset(out->joint_velocity, 0, self->n * sizeof(double));
  memset(out->joint_position_std, 0, self->n * sizeof(double));
  return HALYARD_OK;
}

static int report(void* instance, halyard_report* out, char* message, size_t message_size) {
  (void)message, (void)message_size;
  out->steps = ((state*)instance)->steps;
  return HALYARD_OK;
}

static halyard_estimator_table table = {HALYARD_ESTIMATOR_INTERFACE,
                                        sizeof(halyard_estimator_table),
                                        "fixture",
                                        "joint position = motor position",
                                        create,
                                        destroy,
                                        reset,
                                        update,
                                        estimate,
                                        report,
                                        NULL,
                                        NULL};
