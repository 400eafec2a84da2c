#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnosis/log_check/agreement.h"
#include "diagnosis/log_check/exchanges/assignment.h"
#include "diagnosis/log_check/exchanges/exchanges.h"

namespace halyard {
namespace {

/// The joints whose reading does not agree with their motors.
std::vector<int> disagreeing_joints(const LogUnderCheck& c) {
  const SampledMotion m = sampled_motion(c.log, c.model);
  std::vector<int> joints;
  for (int k = 0; k < c.n(); ++k) {
    if (m.joint[k].empty() || m.expected[k].empty()) continue;
    if (!moves(c, k, m.joint[k]) && !moves(c, k, m.expected[k])) continue;
    if (disagreement(c, m, k, c.rule.explained) == kDisagrees) joints.push_back(k);
  }
  return joints;
}

/// The permutation of the columns of `joints` after which fewest of them disagree, and those that have another column
/// agree best.
std::vector<int> best_columns(const LogUnderCheck& c, Signals Log::*signal, const std::vector<int>& joints) {
  constexpr double kStaysWrong = 1e6, kMost = 1e3;  // cost of a joint that disagrees as before; of one that agrees
  const auto n = static_cast<int>(joints.size());
  const PlaceCost cost = [&](const std::vector<int>& columns) {
    const std::size_t place = columns.size() - 1;
    // Only the joints inboard of a joint move its cable: it does not matter what the others get.
    const LogUnderCheck trial = after_exchange(c, circles_of(signal, joints, completed(columns, n)));
    const bool stays = columns.back() == static_cast<int>(place);
    const double left = disagreement(trial, sampled_motion(trial.log, c.model), joints[place],
                                     stays ? c.rule.explained : c.rule.explained_by_swap);
    return left < kDisagrees ? std::min(left, kMost) : stays ? kStaysWrong : kDisagrees;
  };
  return best_assignments(n, cost, 1).front();
}

struct Candidate {
  ColumnCircle circle;
  double misfit;  ///< mean disagreement of its joints after all exchanges of its signal
};

std::vector<Candidate> candidates(const LogUnderCheck& c, Signals Log::*signal, const std::vector<int>& joints) {
  const std::vector<ColumnCircle> circles = circles_of(signal, joints, best_columns(c, signal, joints));
  const LogUnderCheck trial = after_exchange(c, circles);
  const SampledMotion m = sampled_motion(trial.log, c.model);
  std::vector<Candidate> found;
  for (const ColumnCircle& circle : circles) {
    double sum = 0;
    for (const ColumnPlace& place : circle) sum += disagreement(trial, m, place.k, c.rule.explained_by_swap);
    found.push_back({circle, sum / static_cast<double>(circle.size())});
  }
  return found;
}

/// "joint 1's reading follows motor 2, joint 2's motor 3, joint 3's motor 1"
std::string followed_motors(const ColumnCircle& circle) {
  std::string text;
  for (std::size_t i = 0; i < circle.size(); ++i) {
    const int place = circle[i].k, behind = circle[(i + 1) % circle.size()].k;
    const bool is_motor = circle[i].signal == &Log::motor_position;
    text += fmt::format("{}joint {}'s {}motor {}", i > 0 ? ", " : "", (is_motor ? place : behind) + 1,
                        i > 0 ? "" : "reading follows ", (is_motor ? behind : place) + 1);
  }
  return text;
}

/// What shows that the columns of a circle are exchanged.
std::string seen_in(const ColumnCircle& circle) {
  return (circle.size() == 2
              ? fmt::format("joint {}'s reading follows motor {}, and the reverse", circle[0].k + 1, circle[1].k + 1)
              : followed_motors(circle)) +
         "; expected its own motor";
}

}  // namespace

void check_position_exchanges(LogUnderCheck& c) {
  for (std::vector<int> joints = disagreeing_joints(c); joints.size() > 1;) {
    std::vector<Candidate> all = candidates(c, &Log::motor_position, joints);
    for (Candidate& of_joints : candidates(c, &Log::joint_position, joints)) all.push_back(std::move(of_joints));
    if (all.empty()) return;
    // Motors and sensors that are exchanged look alike: what agrees best explains its joints.
    std::ranges::stable_sort(all, {}, &Candidate::misfit);
    std::set<int> explained;
    std::vector<ColumnCircle> right;
    for (const Candidate& candidate : all) {
      const auto is_free = [&](const ColumnPlace& place) { return !explained.contains(place.k); };
      if (!std::ranges::all_of(candidate.circle, is_free)) continue;
      for (const ColumnPlace& place : candidate.circle) explained.insert(place.k);
      right.push_back(candidate.circle);
    }
    std::ranges::sort(right, {}, [](const ColumnCircle& circle) { return circle[0].k; });
    for (const ColumnCircle& circle : right) reject_exchange(c, circle, seen_in(circle));
    std::vector<int> left = disagreeing_joints(c);
    if (left.size() >= joints.size()) return;
    joints = std::move(left);
  }
}

}  // namespace halyard
