#include "well_formed.h"

/* Good at first; then it says that it cannot work with the record. */
static int update_some(void* instance, const halyard_sample* sample, halyard_innovation* innovation, char* message,
                       size_t message_size) {
  if (((state*)instance)->steps >= 1) {
    strncpy(message, "the record is not for me", message_size);
    return HALYARD_REFUSED;
  }
  return update(instance, sample, innovation, message, message_size);
}

const halyard_estimator_table* halyard_estimator(void) {
  table.update = update_some;
  return &table;
}
