#include "transmission/command_history.h"

#include <algorithm>

namespace halyard {

CommandHistory::CommandHistory(int n_joints, double span_s) : n_(n_joints), span_(span_s) {}

void CommandHistory::reserve(std::size_t samples) {
  time_.reserve(samples);
  command_.reserve(samples * static_cast<std::size_t>(n_));
}

void CommandHistory::clear() {
  time_.clear();
  command_.clear();
  first_ = 0;
}

void CommandHistory::push(double time_s, const double* command) {
  time_.push_back(time_s);
  command_.insert(command_.end(), command, command + n_);
  while (first_ + 3 < time_.size() && time_[first_ + 2] < time_s - span_) ++first_;
  if (first_ > 1024 && first_ > time_.size() / 2) {  // amortised: each sample is moved once
    time_.erase(time_.begin(), time_.begin() + first_);
    command_.erase(command_.begin(), command_.begin() + first_ * n_);
    first_ = 0;
  }
}

double CommandHistory::middle(std::size_t i) const {
  if (i + 1 < time_.size()) return 0.5 * (time_[i] + time_[i + 1]);
  return i > first_ ? time_[i] + 0.5 * (time_[i] - time_[i - 1]) : time_[i];
}

CommandHistory::Segment CommandHistory::segment(int joint, double time_s) const {
  if (first_ == time_.size()) return {0, 0};
  const auto value = [&](std::size_t i) { return command_[i * n_ + joint]; };
  const auto after = std::upper_bound(time_.begin() + first_, time_.end(), time_s) - time_.begin();
  auto next = static_cast<std::size_t>(after);  // the first whose hold's middle is later than time_s
  if (next > first_ && middle(next - 1) > time_s) --next;
  if (next == first_) return {value(first_), 0};
  if (next == time_.size()) return {value(next - 1), 0};
  const double from = middle(next - 1), slope = (value(next) - value(next - 1)) / (middle(next) - from);
  return {value(next - 1) + slope * (time_s - from), slope};
}

}  // namespace halyard
