#include <stddef.h>

/* Writes where nothing is, without the compiler's knowing. */
static void crash(void) {
  volatile int* volatile nowhere = NULL;
  *nowhere = 1;
}
