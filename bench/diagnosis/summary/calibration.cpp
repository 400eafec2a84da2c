#include "bench/diagnosis/summary/calibration.h"

#include <array>
#include <cmath>

namespace halyard::blind {
namespace {

struct Bin {
  Proportion came_true;
  double sum = 0;
  double mean() const { return sum / came_true.of; }
  double distance() const { return std::abs(mean() - came_true.value()); }
};

std::array<Bin, 10> bins_of(const std::vector<Claim>& claims) {
  std::array<Bin, 10> bins;
  for (const Claim& c : claims) {
    Bin& bin = bins[static_cast<std::size_t>(std::clamp(10 * c.probability, 0.0, 9.0))];
    bin.came_true.count(c.came_true);
    bin.sum += c.probability;
  }
  return bins;
}

bool is_true(const Result& r, const Place& place) {
  return is_right(r, place) || std::ranges::find(r.also_true, place) != r.also_true.end();
}

}  // namespace

std::vector<Claim> claims_of(const Results& ran) {
  std::vector<Claim> claims;
  for (const Result* r : ran) {
    const std::vector<NameScore> scores = score_names(*r);
    for (std::size_t i = 0; i < r->named.size(); ++i) {
      const Named& n = r->named[i];
      claims.push_back({n.probability, scores[i] != NameScore::false_name});
      for (const Alternative& a : n.alternatives)
        if (is_right(*r, a.place) || !is_true(*r, a.place)) claims.push_back({a.probability, is_right(*r, a.place)});
    }
    if (is_too_small(*r) || r->situation.off > 1) continue;
    if (r->probability_clean) claims.push_back({*r->probability_clean, r->truth.empty()});
    if (r->probability_none) claims.push_back({*r->probability_none, r->situation.kind == Kind::outside});
  }
  return claims;
}

double largest_distance(const std::vector<Claim>& claims) {
  double most = 0;
  for (const Bin& bin : bins_of(claims))
    if (bin.came_true.of >= kFewestInBin) most = std::max(most, bin.distance());
  return most;
}

std::string calibration_table(const std::vector<Claim>& claims) {
  if (claims.empty()) return "";
  std::string text =
      "| probability | mean | came true | share | 95 % interval | distance |\n|---|---:|---:|---:|---|---:|\n";
  const std::array<Bin, 10> bins = bins_of(claims);
  for (std::size_t b = 0; b < bins.size(); ++b)
    if (bins[b].came_true.of > 0)
      text += fmt::format("| {:.1f} to {:.1f} | {:.3f} | {} | {:.1f} points |\n", 0.1 * static_cast<double>(b),
                          0.1 * static_cast<double>(b + 1), bins[b].mean(), bins[b].came_true.cells(),
                          100 * bins[b].distance());
  return text + "\n";
}

Proportion set_coverage(const Results& ran) {
  Proportion s;
  for (const Result* r : ran)
    for (const bool holds : sets_with_truth(*r)) s.count(holds);
  return s;
}

double probability_of_sets(const Results& ran) {
  double sum = 0, count = 0;
  for (const Result* r : ran)
    for (const Named& n : r->named) {
      sum += n.probability;
      for (const Alternative& a : n.alternatives) sum += a.in_set ? a.probability : 0;
      count += 1;
    }
  return sum / count;
}

Proportion interval_coverage(const Results& ran) {
  Proportion s;
  for (const Result* r : ran)
    for (const TrueEffect& t : r->truth) {
      const auto named = std::ranges::find(r->named, t.place, &Named::place);
      if (named == r->named.end() || !t.form.empty()) continue;
      for (const Parameter& p : named->parameters)
        for (const TrueParameter& truth : t.parameters)
          if (p.name == truth.name && truth.acts) s.count(p.lower <= truth.value && truth.value <= p.upper);
    }
  return s;
}

ErrorRatio error_ratio(const std::vector<double>& error, const std::vector<double>& other) {
  double worst = 0, sum = 0, count = 0;
  for (std::size_t k = 0; k < error.size(); ++k) {
    const double ratio = error[k] / other[k];
    if (!std::isfinite(ratio)) continue;  // a joint whose error cannot be told
    worst = std::max(worst, ratio);
    sum += std::log(ratio);
    count += 1;
  }
  return {worst, std::exp(sum / count)};
}

bool rises_above_given(const Result& r) {
  for (std::size_t k = 0; k < r.holdout.after.size(); ++k)
    if (r.holdout.after[k] > 1.01 * r.holdout.before[k] && r.holdout.rise[k] > 3) return true;
  return false;
}

}  // namespace halyard::blind
