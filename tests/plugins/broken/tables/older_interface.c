#include "well_formed.h"

/* Only the first member may be looked at: what follows is laid out as another version did. */
static struct {
  uint32_t interface_version;
  const char* somewhere;
} older = {HALYARD_ESTIMATOR_INTERFACE - 1, (const char*)1};

const halyard_estimator_table* halyard_estimator(void) {
  (void)table;
  return (const halyard_estimator_table*)&older;
}
