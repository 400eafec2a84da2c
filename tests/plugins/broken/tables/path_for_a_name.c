#include "well_formed.h"

const halyard_estimator_table* halyard_estimator(void) {
  table.name = "a/b,c";
  return &table;
}
