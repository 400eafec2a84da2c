#include "well_formed.h"

static int update_without_deviation(void* instance, const halyard_sample* sample, halyard_innovation* innovation,
                                    char* message, size_t message_size) {
  update(instance, sample, innovation, message, message_size);
  innovation->S_root[0] = 0;
  return HALYARD_OK;
}

const halyard_estimator_table* halyard_estimator(void) {
  table.update = update_without_deviation;
  return &table;
}
