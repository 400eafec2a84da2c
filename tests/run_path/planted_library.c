/* Says in the current folder that it was loaded. */
#include <stdio.h>

__attribute__((constructor)) static void say_so(void) {
  FILE* file = fopen("planted_library_was_loaded", "w");
  if (file) fclose(file);
}
