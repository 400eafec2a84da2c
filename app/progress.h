#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <vector>

#include "app/run_estimate.h"

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

/// Where progress goes if stderr is not a terminal.
enum class PipedProgress { nothing, lines };  ///< lines: one every ten seconds

/// The same for work in stages, with the time that the whole run still takes if no stage comes again:
///
///   diagnose: candidates of round 1:  42 %   at least 3.1 s left
class StageProgress {
 public:
  explicit StageProgress(std::string label, std::vector<UsualStage> run = {},
                         PipedProgress piped = PipedProgress::nothing);
  StageProgress(const StageProgress&) = delete;
  StageProgress& operator=(const StageProgress&) = delete;
  ~StageProgress();

  /// Sets the current stage and its completed fraction, 0 to 1.
  void set(const std::string& stage, double fraction);

 private:
  using Clock = std::chrono::steady_clock;

  const std::string label_;
  const bool on_terminal_, in_lines_;
  const Clock::time_point start_;
  std::mutex mutex_;
  RunEstimate estimate_;
  Clock::time_point last_line_;
  bool drawn_ = false;
};

}  // namespace halyard
