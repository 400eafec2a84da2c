#include "well_formed.h"

static int update_more(void* instance, const halyard_sample* sample, halyard_innovation* innovation, char* message,
                       size_t message_size) {
  update(instance, sample, innovation, message, message_size);
  ++innovation->m;
  return HALYARD_OK;
}

const halyard_estimator_table* halyard_estimator(void) {
  table.update = update_more;
  return &table;
}
