#define _POSIX_C_SOURCE 200809L
#include <unistd.h>

#include "well_formed.h"

/* Starts a process as daemons are started, in a session of its own and without a parent; then neither comes back. */
static int update_with_daemon(void* instance, const halyard_sample* sample, halyard_innovation* innovation,
                              char* message, size_t message_size) {
  volatile int forever = ((state*)instance)->steps >= 1;
  if (forever && fork() == 0 && setsid() > 0 && fork() != 0) _exit(0);
  while (forever) sleep(1);
  return update(instance, sample, innovation, message, message_size);
}

const halyard_estimator_table* halyard_estimator(void) {
  table.update = update_with_daemon;
  return &table;
}
