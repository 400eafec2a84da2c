#pragma once
/// Past motor commands, for effects in which torque acts after a delay.

#include <vector>

#include "transmission/scalar.h"

namespace halyard {

class CommandHistory {
 public:
  /// Remembers commands of n joints for at least the last `span_s` seconds.
  CommandHistory(int n_joints, double span_s);

  /// Takes the memory for so many commands at once. Twice those of the span are enough.
  void reserve(std::size_t samples);
  /// Forgets all commands.
  void clear();
  /// Adds the command that holds from time_s until the next one. Times must increase.
  void push(double time_s, const double* command);

  /// Command of a joint at a time. Each command is held from its time to the next one's. The returned command is linear
  /// between the middles of these hold intervals, so it has a derivative and no delay on average. Before the middle of
  /// the first interval the value is the first command; after the middle of the last interval it is the last command.
  /// The last hold interval is assumed to be as long as the one before.
  double at(int joint, double time_s) const { return segment(joint, time_s).value; }
  HALYARD_INLINE Dual at(int joint, const Dual& time_s) const {
    const Segment s = segment(joint, time_s.a);
    return {s.value, s.slope * time_s.d};
  }
  HALYARD_INLINE Lanes at(int joint, const Lanes& time_s) const {
    Lanes r;
    for (int i = 0; i < kLaneWidth; ++i) r.set(i, segment(joint, time_s[i]).value);
    return r;
  }

 private:
  struct Segment {
    double value, slope;
  };
  Segment segment(int joint, double time_s) const;
  double middle(std::size_t sample) const;  ///< middle of the sample's hold interval, s

  int n_;
  double span_;
  std::vector<double> time_;
  std::vector<double> command_;  ///< [time][joint]
  std::size_t first_ = 0;        ///< samples before this one are forgotten
};

}  // namespace halyard
