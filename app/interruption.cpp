#include "app/interruption.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string>
#include <thread>

#include "model/output/unfinished.h"

namespace halyard {
namespace {

const char* name_of(int signal) { return signal == SIGINT ? "SIGINT" : signal == SIGTERM ? "SIGTERM" : "SIGHUP"; }

std::atomic<const char*> kept = nullptr;

/// In a thread of its own, which may take locks; a signal handler may not.
[[noreturn]] void wait_and_end(const sigset_t& signals) {
  int signal = 0;
  while (sigwait(&signals, &signal) != 0) {}
  remove_everything_unfinished();
  const std::string wipe = ::isatty(STDERR_FILENO) ? "\r\033[K" : "";  // a line of progress may stand there
  const char* what = kept;
  const std::string line = wipe + "halyard: ended by " + name_of(signal) + "; unfinished outputs were removed" +
                           (what ? std::string("; ") + what : "") + "\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
  ::_exit(128 + signal);
}

}  // namespace

KeptOnInterruption::KeptOnInterruption(const char* what) { kept = what; }
KeptOnInterruption::~KeptOnInterruption() { kept = nullptr; }

void occupy_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

void end_cleanly_on_signals() {
  for (const int signal : {SIGPIPE, SIGXFSZ}) ::signal(signal, SIG_IGN);
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    sigaction(signal, nullptr, &now);
    if (now.sa_handler != SIG_IGN) sigaddset(&signals, signal);
  }
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread(wait_and_end, signals).detach();
}

}  // namespace halyard
