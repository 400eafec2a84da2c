#include "well_formed.h"

static int revise(void* instance, int32_t at_end, double* time_s, halyard_estimate* out, char* message,
                  size_t message_size) {
  (void)at_end;
  *time_s = 1e6;
  return estimate(instance, out, message, message_size);
}

const halyard_estimator_table* halyard_estimator(void) {
  table.revise = revise;
  return &table;
}
