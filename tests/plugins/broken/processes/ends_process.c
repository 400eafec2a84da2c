#include "well_formed.h"

/* Good at first; then it takes the whole process along, in good order. */
static int update_exit(void* instance, const halyard_sample* sample, halyard_innovation* innovation, char* message,
                       size_t message_size) {
  if (((state*)instance)->steps >= 1) exit(0);
  return update(instance, sample, innovation, message, message_size);
}

const halyard_estimator_table* halyard_estimator(void) {
  table.update = update_exit;
  return &table;
}
