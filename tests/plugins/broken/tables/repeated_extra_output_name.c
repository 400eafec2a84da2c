#include "well_formed.h"

static const char* name_of(void* instance, size_t i) {
  (void)instance;
  return i < 2 ? "gain" : NULL;
}

const halyard_estimator_table* halyard_estimator(void) {
  table.extra_output_name = name_of;
  return &table;
}
