#include "well_formed.h"

const halyard_estimator_table* halyard_estimator(void) {
  table.table_size = sizeof table - sizeof(void*);
  return &table;
}
