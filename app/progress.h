#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace halyard {

/// A progress line on a terminal, updated in place during long work and removed at its end:
///
///   simulate:  42 %   8.3 s/s   1.4 s left
///
/// Nothing is written if stderr is not a terminal. Safe to call from several threads.
class Progress {
 public:
  /// total: amount of work. unit: text for the unit of the displayed rate, which is the unit of `total` per second.
  Progress(std::string label, double total, std::string unit);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// Sets the completed amount, out of total.
  void set(double done);
  /// Adds to the completed amount.
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

/// The same for work in stages of unknown length:
///
///   diagnose: candidates of round 1:  42 %   3.1 s left
class StageProgress {
 public:
  explicit StageProgress(std::string label);
  StageProgress(const StageProgress&) = delete;
  StageProgress& operator=(const StageProgress&) = delete;
  ~StageProgress();

  /// Sets the current stage and its completed fraction, 0 to 1.
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
