#include "well_formed.h"

/* Fills the buffer to its last byte, lines in it, and leaves the zero out. */
static int update_long(void* instance, const halyard_sample* sample, halyard_innovation* innovation, char* message,
                       size_t message_size) {
  (void)instance, (void)sample, (void)innovation;
  memset(message, 'x', message_size);
  message[1] = '\n';
  return HALYARD_FAILED;
}

const halyard_estimator_table* halyard_estimator(void) {
  table.update = update_long;
  return &table;
}
