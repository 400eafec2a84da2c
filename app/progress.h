#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace halyard {

/// One line on a terminal, updated in place while long work goes on, and wiped when it ends:
///
///   simulate:  42 %   8.3 s/s   1.4 s left
///
/// Nothing is written where stderr is no terminal. Safe to call from several threads.
class Progress {
 public:
  /// total: amount of work in the unit that the rate is shown in, per second.
  Progress(std::string label, double total, std::string unit);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// The amount that is done now, of total.
  void set(double done);
  /// Adds to what is done.
  void add(double amount);

 private:
  using Clock = std::chrono::steady_clock;
  void draw();

  const std::string label_;
  const double total_;
  const std::string unit_;
  const bool visible_;
  const Clock::time_point start_;
  std::mutex mutex_;
  double done_ = 0;
  Clock::time_point last_drawn_;
  bool drawn_ = false;
};

/// The same for work in stages whose length is not known beforehand:
///
///   diagnose: candidates of round 1:  42 %   3.1 s left
class StageProgress {
 public:
  explicit StageProgress(std::string label);
  StageProgress(const StageProgress&) = delete;
  StageProgress& operator=(const StageProgress&) = delete;
  ~StageProgress();

  /// What is being done and which part of it is done, 0 to 1.
  void set(const std::string& stage, double fraction);

 private:
  using Clock = std::chrono::steady_clock;

  const std::string label_;
  const bool visible_;
  std::mutex mutex_;
  std::string stage_;
  Clock::time_point stage_start_;
  bool drawn_ = false;
};

}  // namespace halyard
