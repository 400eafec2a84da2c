#include "crash.h"
#include "well_formed.h"

/* Good at first. */
static int update_crash(void* instance, const halyard_sample* sample, halyard_innovation* innovation, char* message,
                        size_t message_size) {
  if (((state*)instance)->steps >= 1) crash();
  return update(instance, sample, innovation, message, message_size);
}

const halyard_estimator_table* halyard_estimator(void) {
  table.update = update_crash;
  return &table;
}
