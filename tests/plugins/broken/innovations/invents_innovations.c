#include "well_formed.h"

/* Of a motor whose position is missing, too. */
static int update_all(void* instance, const halyard_sample* sample, halyard_innovation* innovation, char* message,
                      size_t message_size) {
  size_t i;
  update(instance, sample, innovation, message, message_size);
  for (i = 0; i < innovation->m; ++i) innovation->nu[i] = 0.5;
  return HALYARD_OK;
}

const halyard_estimator_table* halyard_estimator(void) {
  table.update = update_all;
  return &table;
}
