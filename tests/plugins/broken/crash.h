#include <stddef.h>

/* Writes where nothing is, without the compiler's knowing; its sanitizers would end the program in their own way. */
__attribute__((no_sanitize("address", "undefined"))) static void crash(void) {
  volatile int* volatile nowhere = NULL;
  *nowhere = 1;
}
