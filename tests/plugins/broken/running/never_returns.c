#include "well_formed.h"

/* Good at first; then it never comes back. */
static int update_forever(void* instance, const halyard_sample* sample, halyard_innovation* innovation, char* message,
                          size_t message_size) {
  volatile int forever = ((state*)instance)->steps >= 1;
  while (forever) {}
  return update(instance, sample, innovation, message, message_size);
}

const halyard_estimator_table* halyard_estimator(void) {
  table.update = update_forever;
  return &table;
}
