#include "crash.h"
#include "well_formed.h"

/* In the place of a built-in estimator. */
static int update_crash(void* instance, const halyard_sample* sample, halyard_innovation* innovation, char* message,
                        size_t message_size) {
  (void)instance, (void)sample, (void)innovation, (void)message, (void)message_size;
  crash();
  return HALYARD_OK;
}

const halyard_estimator_table* halyard_estimator(void) {
  table.name = "ekf";
  table.update = update_crash;
  return &table;
}
