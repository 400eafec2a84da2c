#include "bench/diagnosis/results/scoring.h"

#include <algorithm>

namespace halyard::blind {
namespace {

constexpr double kLikely = 0.5;  ///< a name above this probability is a claim

bool is_also_true(const Result& r, const Place& place) {
  return std::ranges::find(r.also_true, place) != r.also_true.end();
}

/// Removes the place from those that are left; false if it is not among them.
bool take(std::vector<Place>& left, const Place& place) {
  const auto found = std::ranges::find(left, place);
  if (found == left.end()) return false;
  left.erase(found);
  return true;
}

/// What a name can be right about.
std::vector<Place> right_names(const Result& r) {
  std::vector<Place> names;
  if (r.situation.kind != Kind::outside)
    for (const TrueEffect& t : r.truth) names.push_back(t.place);
  return names;
}

/// The first name that is not merely also true; null if there is none.
const Named* first_name(const Result& r) {
  const std::vector<NameScore> scores = score_names(r);
  for (std::size_t i = 0; i < r.named.size(); ++i)
    if (scores[i] != NameScore::also_true) return &r.named[i];
  return nullptr;
}

bool right_first(const Result& r) {
  const Named* first = first_name(r);
  return first && is_right(r, first->place);
}

bool right_or_alternative(const Result& r) {
  if (right_first(r)) return true;
  const Named* first = first_name(r);
  if (!first || first->alternatives.size() > 2) return false;
  return std::ranges::any_of(first->alternatives, [&](const Alternative& a) { return is_right(r, a.place); });
}

bool visible_named(const Result& r) {
  return std::ranges::all_of(r.truth, [&](const TrueEffect& t) { return !t.is_visible() || is_named(r, t); });
}

bool claims_something(const Result& r) {
  return std::ranges::any_of(r.named, [](const Named& n) { return n.probability > kLikely; });
}

}  // namespace

std::vector<NameScore> score_names(const Result& r) {
  std::vector<Place> left = right_names(r);
  std::vector<NameScore> scores;
  for (const Named& n : r.named)
    scores.push_back(take(left, n.place)        ? NameScore::right
                     : is_also_true(r, n.place) ? NameScore::also_true
                                                : NameScore::false_name);
  return scores;
}

std::vector<Place> truth_without_name(const Result& r) {
  std::vector<Place> left = right_names(r);
  for (const Named& n : r.named) take(left, n.place);
  return left;
}

std::vector<bool> sets_with_truth(const Result& r) {
  std::vector<Place> left = truth_without_name(r);
  std::vector<bool> holds;
  const std::vector<NameScore> scores = score_names(r);
  for (std::size_t i = 0; i < r.named.size(); ++i)
    holds.push_back(scores[i] != NameScore::false_name ||
                    std::ranges::any_of(r.named[i].alternatives,
                                        [&](const Alternative& a) { return a.in_set && take(left, a.place); }));
  return holds;
}

bool is_right(const Result& r, const Place& named) {
  return r.situation.kind != Kind::outside &&
         std::ranges::any_of(r.truth, [&](const TrueEffect& t) { return t.place == named; });
}

bool is_named(const Result& r, const TrueEffect& truth) {
  return std::ranges::find(r.named, truth.place, &Named::place) != r.named.end();
}

bool is_named_or_alternative(const Result& r, const TrueEffect& truth) {
  return is_named(r, truth) || std::ranges::any_of(r.named, [&](const Named& n) {
           return std::ranges::find(n.alternatives, truth.place, &Alternative::place) != n.alternatives.end();
         });
}

int false_names(const Result& r) { return static_cast<int>(std::ranges::count(score_names(r), NameScore::false_name)); }

bool strictly_right(const Result& r) {
  if (!r.failure.empty()) return false;
  switch (r.situation.kind) {
    case Kind::clean: return r.verdict == "clean";
    case Kind::effect:
    case Kind::form: return right_first(r) && false_names(r) == 0 && r.unexplained.empty();
    case Kind::two_at_joint:
    case Kind::three: return visible_named(r) && false_names(r) == 0 && r.unexplained.empty();
    case Kind::outside: break;
  }
  return r.verdict == "unknown" && !claims_something(r);
}

bool loosely_right(const Result& r) {
  if (!r.failure.empty()) return false;
  switch (r.situation.kind) {
    case Kind::clean: return false_names(r) == 0;
    case Kind::effect:
    case Kind::form: return right_or_alternative(r);
    case Kind::two_at_joint:
    case Kind::three: return visible_named(r);
    case Kind::outside: break;
  }
  return admits_rest(r);
}

bool is_too_small(const Result& r) {
  return !r.truth.empty() && std::ranges::none_of(r.truth, &TrueEffect::is_visible);
}

bool admits_rest(const Result& r) { return r.verdict == "unknown" || (!r.named.empty() && !r.unexplained.empty()); }

}  // namespace halyard::blind
