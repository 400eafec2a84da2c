/// halyard: joint positions of cable-driven arms from motor signals.
///
/// Exit codes: 0 done; 2 wrong usage or unreadable or invalid input; 128 + signal if a signal ended it; 1 anything
/// else. A failure is one line on stderr.

#include <glog/logging.h>
#include <malloc.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

#include "app/command_line.h"
#include "app/interruption.h"
#include "app/terminal/terminal.h"
#include "model/input_error.h"
#include "transmission/lanes/instruction_set.h"

namespace {

int fail(const std::exception& error, int code) {
  halyard::tell(error.what());
  return code;
}

/// What was printed may still wait in a buffer: a full disk behind stdout is a failure too.
void flush_stdout() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
    throw std::runtime_error(std::string("stdout: cannot be written: ") + std::strerror(errno));
  }
}

/// The environment is input, too: what is wrong in it is told at once.
void check_environment() {
  try {
    halyard::instruction_sets();
  } catch (const std::invalid_argument& error) {
    throw halyard::InputError(error.what());
  }
}

/// Fits run on short-lived threads. With an arena for each, freed memory stays where the next thread does not look:
/// a diagnosis took twice the memory and a seventh more time.
void share_freed_memory() { mallopt(M_ARENA_MAX, 2); }

}  // namespace

int main(int argc, char** argv) {
  halyard::occupy_closed_streams();
  halyard::end_cleanly_on_signals();
  share_freed_memory();
  // Ceres writes to the log of why it gives up; what a fit came to is in the output, and stderr is for one line.
  FLAGS_minloglevel = google::GLOG_FATAL;
  try {
    check_environment();
    const int code = halyard::run_command_line(argc, argv);
    flush_stdout();
    return code;
  } catch (const halyard::InputError& error) {
    return fail(error, 2);
  } catch (const std::bad_alloc&) {
    return fail(std::runtime_error("halyard: memory ran out; use shorter logs or scenarios, or fewer --jobs"), 1);
  } catch (const std::exception& error) {
    return fail(error, 1);
  } catch (...) {  // of an effect in a module
    return fail(std::runtime_error("halyard: an exception of unknown type, perhaps from an effect of a module"), 1);
  }
}
