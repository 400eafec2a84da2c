#pragma once
/// How long a run of several stages still takes, at least.

#include <map>
#include <string>
#include <vector>

namespace halyard {

/// A kind of stage, such as "fits" of "fits of round 2", and how long it usually takes compared with the other kinds.
struct UsualStage {
  std::string kind;
  double usual;
};

/// Stages follow each other in a usual order; some come again, for example in each round of a search. A kind that has
/// been seen is expected to take as long as the last time. The others are expected to take their usual time, scaled by
/// what the run has taken so far over what is usual.
class RunEstimate {
 public:
  explicit RunEstimate(std::vector<UsualStage> stages) : stages_(std::move(stages)) {}

  /// Least time left, s: the rest of this stage, and each kind that usually follows, once. fraction: completed share of
  /// the stage; now: s, never less than in the call before.
  double left(const std::string& stage, double fraction, double now);

 private:
  double expected(const UsualStage& stage) const;
  double scale() const;

  std::vector<UsualStage> stages_;
  std::map<std::string, double> taken_;  ///< [kind] s, the last time
  std::string stage_;
  double started_ = 0;
};

}  // namespace halyard
