#pragma once
/// Past motor commands, for effects that answer late: torque that acts after a delay.

#include <vector>

#include "transmission/scalar.h"

namespace halyard {

class CommandHistory {
 public:
  /// Remembers commands of n joints for at least the last `span_s` seconds.
  CommandHistory(int n_joints, double span_s);

  /// The command from time_s on, until the next one. Times increase.
  void push(double time_s, const double* command);

  /// Command of a joint at a time, linear between the middles of the holds so that it can be differentiated and is late
  /// by nothing on average; before the first middle the first command, after the last the last. The last command's hold
  /// is taken to be as long as the one before.
  double at(int joint, double time_s) const;
  Dual at(int joint, const Dual& time_s) const;
  Lanes at(int joint, const Lanes& time_s) const;

 private:
  struct Segment {
    double value, slope;
  };
  Segment segment(int joint, double time_s) const;
  double middle(std::size_t sample) const;  ///< of its hold

  int n_;
  double span_;
  std::vector<double> time_;
  std::vector<double> command_;  ///< [time][joint]
  std::size_t first_ = 0;        ///< samples before this one are forgotten
};

}  // namespace halyard
