#include "well_formed.h"

/* "a", "aa", ...: each is a new name. */
static const char* name_of(void* instance, size_t i) {
  static char letters[1000];
  (void)instance;
  memset(letters, 0, sizeof letters);
  memset(letters, i < 50 ? 'a' : 'b', i % 50 + 1);
  return letters;
}

const halyard_estimator_table* halyard_estimator(void) {
  table.extra_output_name = name_of;
  return &table;
}
