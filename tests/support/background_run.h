#pragma once
/// A run of the built program that goes on beside the test.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "model/output/output_files.h"

namespace halyard::testing_program {

/// Waits until `condition()`; for at most a minute, ample for a machine with other work.
template <class Condition>
bool comes_true(const Condition& condition) {
  for (int i = 0; i < 6000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// A process as /proc/ID/stat describes it.
struct Process {
  pid_t id = 0, parent = 0, group = 0;
  char state = 0;
};

inline std::vector<Process> running_processes() {
  std::vector<Process> all;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const pid_t id = std::atoi(entry.path().filename().c_str());
    std::ifstream file(entry.path() / "stat");
    std::string text;
    if (id == 0 || !std::getline(file, text)) continue;
    std::istringstream rest(text.substr(text.rfind(')') + 1));
    Process p{.id = id};
    rest >> p.state >> p.parent >> p.group;
    if (p.state != 'Z') all.push_back(p);
  }
  return all;
}

/// Leaves beside `path` what a process leaves that is killed while it writes this file.
inline void kill_while_writing(const std::filesystem::path& path) {
  const pid_t writer = ::fork();
  if (writer == 0) {
    OutputFiles files;
    files.add(path, "half a line");
    ::raise(SIGKILL);
  }
  ::waitpid(writer, nullptr, 0);
}

class BackgroundRun {
 public:
  /// Runs in `folder`; stderr goes to the file `err`, stdout to the open file `out`.
  BackgroundRun(const std::filesystem::path& program, const std::filesystem::path& folder,
                const std::vector<std::string>& arguments, const std::filesystem::path& err, int out = -1) {
    std::vector<char*> argv = {const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    id_ = ::fork();
    if (id_ != 0) return;
    const int err_file = ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    const int out_file = out >= 0 ? out : ::open("/dev/null", O_WRONLY);
    if (::chdir(folder.c_str()) == 0 && ::dup2(out_file, 1) == 1 && ::dup2(err_file, 2) == 2)
      ::execv(program.c_str(), argv.data());
    ::_exit(127);
  }
  BackgroundRun(const BackgroundRun&) = delete;
  BackgroundRun& operator=(const BackgroundRun&) = delete;
  ~BackgroundRun() {
    if (id_ > 0) send(SIGKILL), wait();
  }

  pid_t id() const { return id_; }
  void send(int signal) const { ::kill(id_, signal); }
  /// Exit code; 128 + signal if one ended it.
  int wait() {
    int status = 0;
    ::waitpid(id_, &status, 0);
    id_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  /// Processes that it started, and those that they started.
  std::vector<Process> descendants() const {
    const std::vector<Process> all = running_processes();
    std::vector<Process> found;
    std::vector<pid_t> parents = {id_};
    for (std::size_t i = 0; i < parents.size(); ++i)
      for (const Process& p : all)
        if (p.parent == parents[i]) found.push_back(p), parents.push_back(p.id);
    return found;
  }
  /// Processes that it started.
  std::vector<Process> children() const {
    std::vector<Process> all = running_processes();
    std::erase_if(all, [this](const Process& p) { return p.parent != id_; });
    return all;
  }

 private:
  pid_t id_ = -1;
};

}  // namespace halyard::testing_program
