#pragma once

namespace halyard {

/// Call before anything else is opened: where a standard stream is closed, no output file takes its number, and what is
/// printed there is an error of the write.
void occupy_closed_streams();

/// Call in main() before other threads start. From then on SIGINT, SIGTERM and SIGHUP end the program with one
/// line on stderr and exit code 128 + signal: 130, 143, 129. Outputs are then complete or absent, and the processes of
/// estimators end with the program. A signal that the caller set to be ignored, as nohup does, stays ignored. A closed
/// pipe and a limit of the file size (SIGPIPE, SIGXFSZ) become errors of the write instead of ending the program.
void end_cleanly_on_signals();

/// While it lives, the line that tells of a signal also tells what is kept and how to go on.
class KeptOnInterruption {
 public:
  explicit KeptOnInterruption(const char* what);
  ~KeptOnInterruption();
  KeptOnInterruption(const KeptOnInterruption&) = delete;
  KeptOnInterruption& operator=(const KeptOnInterruption&) = delete;
};

}  // namespace halyard
