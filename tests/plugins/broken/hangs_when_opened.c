#define _POSIX_C_SOURCE 200809L
#include <unistd.h>

#include "well_formed.h"

/* As a static constructor in C++ may: nothing of the module can be called. */
__attribute__((constructor)) static void hang(void) {
  volatile int forever = 1;
  while (forever) pause();
}

const halyard_estimator_table* halyard_estimator(void) { return &table; }
