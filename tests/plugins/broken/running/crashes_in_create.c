#include "crash.h"
#include "well_formed.h"

/* It does not even begin. */
static int create_crash(const halyard_config* config, void** instance, char* message, size_t message_size) {
  crash();
  return create(config, instance, message, message_size);
}

const halyard_estimator_table* halyard_estimator(void) {
  table.create = create_crash;
  return &table;
}
