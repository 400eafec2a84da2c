#include "evaluation/worker/supervisor.h"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <fstream>

namespace halyard {
namespace {

/// The child stays a zombie, so that its number belongs to no other process.
bool has_ended(pid_t child) {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid == child;
}

/// `signals`, blocked: SIGCHLD and those that ask for the end.
void wait_until_needless(pid_t child, int answer, const sigset_t& signals) {
  const int arrived = signalfd(-1, &signals, SFD_CLOEXEC);
  pollfd waits[] = {{answer, 0, 0}, {arrived, POLLIN, 0}};
  while (!has_ended(child)) {
    if (poll(waits, 2, -1) <= 0) continue;
    if (waits[0].revents != 0) return;  // no reader
    signalfd_siginfo signal;
    if (read(arrived, &signal, sizeof signal) == sizeof signal && signal.ssi_signo != SIGCHLD) return;
  }
}

/// False if there is none that this process may kill.
bool kill_children() {
  std::ifstream children("/proc/thread-self/children");
  bool any = false;
  for (pid_t child; children >> child;)
    if (kill(child, SIGKILL) == 0) any = true;
  return any;
}

/// Returns how the child ended, as waitpid() says it.
int end_all(pid_t child) {
  for (const pid_t target : {child, -child}) kill(target, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  // Those whose parents are killed become children of this process, before it is told of the parents' ends.
  while (kill_children()) waitpid(-1, nullptr, 0);
  return status;
}

[[noreturn]] void end_as(int status, const sigset_t& signals) {
  if (WIFSIGNALED(status)) {
    prctl(PR_SET_DUMPABLE, 0);  // the child has written the core
    sigprocmask(SIG_UNBLOCK, &signals, nullptr);
    raise(WTERMSIG(status));
  }
  _exit(WEXITSTATUS(status));
}

}  // namespace

int continue_in_supervised_child(int answer) {
  sigset_t signals, before;
  sigemptyset(&signals);
  for (const int signal : {SIGCHLD, SIGTERM, SIGINT, SIGHUP}) sigaddset(&signals, signal);
  sigprocmask(SIG_BLOCK, &signals, &before);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  const pid_t child = fork();
  if (child < 0) return errno;
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    setpgid(0, 0);
    sigprocmask(SIG_SETMASK, &before, nullptr);
    return 0;
  }
  setpgid(child, child);  // here too: it may be killed before it runs
  wait_until_needless(child, answer, signals);
  end_as(end_all(child), signals);
}

}  // namespace halyard
