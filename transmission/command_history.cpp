#include "transmission/command_history.h"

#include <algorithm>

namespace halyard {

CommandHistory::CommandHistory(int n_joints, double span_s) : n_(n_joints), span_(span_s) {}

void CommandHistory::push(double time_s, const double* command) {
  time_.push_back(time_s);
  command_.insert(command_.end(), command, command + n_);
  while (first_ + 2 < time_.size() && time_[first_ + 1] < time_s - span_) ++first_;
  if (first_ > 1024 && first_ > time_.size() / 2) {   // amortised: each sample is moved once
    time_.erase(time_.begin(), time_.begin() + first_);
    command_.erase(command_.begin(), command_.begin() + first_ * n_);
    first_ = 0;
  }
}

CommandHistory::Segment CommandHistory::segment(int joint, double time_s) const {
  const auto begin = time_.begin() + first_;
  if (begin == time_.end()) return {0, 0};
  const auto next = std::upper_bound(begin, time_.end(), time_s);
  const auto value = [&](auto it) { return command_[(it - time_.begin()) * n_ + joint]; };
  if (next == begin) return {value(begin), 0};
  const auto last = next - 1;
  if (next == time_.end()) return {value(last), 0};
  const double slope = (value(next) - value(last)) / (*next - *last);
  return {value(last) + slope * (time_s - *last), slope};
}

double CommandHistory::at(int joint, double time_s) const { return segment(joint, time_s).value; }

Dual CommandHistory::at(int joint, const Dual& time_s) const {
  const Segment s = segment(joint, time_s.a);
  return {s.value, s.slope * time_s.d};
}

Lanes CommandHistory::at(int joint, const Lanes& time_s) const {
  Lanes r;
  for (int i = 0; i < kLaneWidth; ++i) r.set(i, segment(joint, time_s[i]).value);
  return r;
}

}  // namespace halyard
