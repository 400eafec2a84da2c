#include "app/progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "app/terminal/terminal.h"

namespace halyard {
namespace {

constexpr std::chrono::milliseconds kDrawEvery{100};
constexpr std::chrono::seconds kLineEvery{10};
constexpr const char* kWipeLine = "\r\033[K";

std::string duration_text(double seconds) {
  if (seconds < 100) return fmt::format("{:.1f} s", seconds);
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

/// Puts a line of progress in the place of the last one.
void draw_over(const std::string& line) {
  std::fprintf(stderr, "%s%s", kWipeLine, one_message(line).c_str());
  std::fflush(stderr);
}

}  // namespace

Progress::Progress(std::string label, double total, std::string unit)
    : label_(std::move(label)),
      total_(total),
      unit_(std::move(unit)),
      visible_(total > 0 && ::isatty(STDERR_FILENO)),
      start_(Clock::now()),
      last_drawn_(start_) {}

Progress::~Progress() {
  if (drawn_) draw_over("");
}

void Progress::set(double done) {
  if (!visible_) return;
  const std::lock_guard lock(mutex_);
  done_ = done;
  draw();
}

void Progress::add(double amount) {
  if (!visible_) return;
  const std::lock_guard lock(mutex_);
  done_ += amount;
  draw();
}

void Progress::draw() {
  const Clock::time_point now = Clock::now();
  if (now - last_drawn_ < kDrawEvery || done_ <= 0) return;
  last_drawn_ = now;
  drawn_ = true;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double rate = done_ / elapsed;
  draw_over(fmt::format("{}: {:3.0f} %   {:.3g} {}/s   {} left", label_, 100 * std::min(1.0, done_ / total_), rate,
                        unit_, duration_text(std::max(0.0, total_ - done_) / rate)));
}

StageProgress::StageProgress(std::string label, std::vector<UsualStage> run, PipedProgress piped)
    : label_(std::move(label)),
      on_terminal_(::isatty(STDERR_FILENO)),
      in_lines_(!on_terminal_ && piped == PipedProgress::lines),
      start_(Clock::now()),
      estimate_(std::move(run)),
      last_line_(start_) {}

StageProgress::~StageProgress() {
  if (drawn_) draw_over("");
}

void StageProgress::set(const std::string& stage, double fraction) {
  if (!on_terminal_ && !in_lines_) return;
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  const double left = estimate_.left(stage, fraction, std::chrono::duration<double>(now - start_).count());
  if (in_lines_ && now - last_line_ < kLineEvery) return;
  const std::string line = fmt::format("{}: {}: {:3.0f} %{}", label_, stage, 100 * std::min(1.0, fraction),
                                       left > 0 ? fmt::format("   at least {} left", duration_text(left)) : "");
  if (in_lines_) tell(line);
  else draw_over(line);
  last_line_ = now;
  drawn_ = on_terminal_;
}

}  // namespace halyard
