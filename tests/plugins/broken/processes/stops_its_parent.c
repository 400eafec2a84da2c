#define _POSIX_C_SOURCE 200809L
#include <signal.h>
#include <unistd.h>

#include "well_formed.h"

/* Stops the process that supervises it, and does not come back. */
static int update_in_peace(void* instance, const halyard_sample* sample, halyard_innovation* innovation, char* message,
                           size_t message_size) {
  volatile int forever = ((state*)instance)->steps >= 1;
  if (forever) kill(getppid(), SIGSTOP);
  while (forever) sleep(1);
  return update(instance, sample, innovation, message, message_size);
}

const halyard_estimator_table* halyard_estimator(void) {
  table.update = update_in_peace;
  return &table;
}
