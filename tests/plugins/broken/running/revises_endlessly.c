#include "well_formed.h"

static double first_time;

static int reset_time(void* instance, const halyard_sample* first, char* message, size_t message_size) {
  first_time = first->time_s;
  return reset(instance, first, message, message_size);
}

static int revise(void* instance, int32_t at_end, double* time_s, halyard_estimate* out, char* message,
                  size_t message_size) {
  (void)at_end;
  *time_s = first_time;
  return estimate(instance, out, message, message_size);
}

const halyard_estimator_table* halyard_estimator(void) {
  table.reset = reset_time;
  table.revise = revise;
  return &table;
}
