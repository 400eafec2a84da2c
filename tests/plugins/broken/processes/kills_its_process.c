#define _POSIX_C_SOURCE 200809L
#include <signal.h>
#include <unistd.h>

#include "well_formed.h"

/* Good at first; then its process ends as those do that the system kills when memory runs out. */
static int update_killed(void* instance, const halyard_sample* sample, halyard_innovation* innovation, char* message,
                         size_t message_size) {
  if (((state*)instance)->steps >= 1) kill(getpid(), SIGKILL);
  return update(instance, sample, innovation, message, message_size);
}

const halyard_estimator_table* halyard_estimator(void) {
  table.update = update_killed;
  return &table;
}
