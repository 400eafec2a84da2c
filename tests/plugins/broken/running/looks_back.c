#include "well_formed.h"

/* Not broken: it says twice the position besides, and of the sample before what the next one shows, for one
 * instance. */
static double last_time, previous_time;
static double previous[8];
static int due;

static int reset_time(void* instance, const halyard_sample* first, char* message, size_t message_size) {
  last_time = first->time_s;
  due = 0;
  return reset(instance, first, message, message_size);
}

static int update_time(void* instance, const halyard_sample* sample, halyard_innovation* innovation, char* message,
                       size_t message_size) {
  memcpy(previous, ((state*)instance)->position, sizeof previous);
  previous_time = last_time;
  last_time = sample->time_s;
  due = 1;
  return update(instance, sample, innovation, message, message_size);
}

static const char* name_of(void* instance, size_t i) {
  (void)instance;
  return i == 0 ? "twice" : i == 1 ? "none" : NULL;
}

static int estimate_more(void* instance, halyard_estimate* out, char* message, size_t message_size) {
  size_t k, n = ((state*)instance)->n;
  estimate(instance, out, message, message_size);
  for (k = 0; k < n; ++k) out->extra_outputs[k] = 2 * out->joint_position[k];
  return HALYARD_OK;
}

static int revise(void* instance, int32_t at_end, double* time_s, halyard_estimate* out, char* message,
                  size_t message_size) {
  size_t k, n = ((state*)instance)->n;
  (void)at_end;
  if (!due) return HALYARD_OK;
  due = 0;
  *time_s = previous_time;
  estimate(instance, out, message, message_size);
  for (k = 0; k < n; ++k) {
    out->joint_position[k] = (out->joint_position[k] + previous[k]) / 2;
    out->extra_outputs[k] = 2 * out->joint_position[k];
  }
  return HALYARD_OK;
}

const halyard_estimator_table* halyard_estimator(void) {
  table.reset = reset_time;
  table.update = update_time;
  table.estimate = estimate_more;
  table.extra_output_name = name_of;
  table.revise = revise;
  return &table;
}
