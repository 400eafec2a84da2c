#include "bench/diagnosis/summary/calibration.h"

#include <cmath>
#include <limits>

#include "bench/diagnosis/summary/listed_parameter.h"

namespace halyard::blind {
namespace {

void count_parameter(const std::string& effect, const TrueParameter& truth, const std::vector<Parameter>& found,
                     ParameterCounts& counts) {
  const ListedParameter listed = listed_parameter(effect, truth.name);
  const auto p = std::ranges::find(found, truth.name, &Parameter::name);
  if (p == found.end()) counts.off_neutral.count(truth.value != listed.neutral);
  else if (listed.is_whole) counts.whole.count(p->value == truth.value);
  else
    (p->value == listed.neutral ? counts.reset : counts.kept).count(p->lower <= truth.value && truth.value <= p->upper);
}

}  // namespace

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

ParameterCounts parameter_counts(const Results& ran) {
  ParameterCounts counts;
  for (const Result* r : ran)
    for (const TrueEffect& t : r->truth) {
      const auto named = std::ranges::find(r->named, t.place, &Named::place);
      if (named == r->named.end() || !t.form.empty()) continue;
      for (const TrueParameter& truth : t.parameters)
        if (truth.acts) count_parameter(t.place.effect, truth, named->parameters, counts);
    }
  return counts;
}

std::vector<double> interval_coverages(const Results& ran) {
  std::vector<double> means;
  for (const Result* r : ran) {
    if (!r->interval_coverage) continue;
    double sum = 0, count = 0;
    for (const double of_joint : *r->interval_coverage)
      if (std::isfinite(of_joint)) sum += of_joint, count += 1;
    if (count > 0) means.push_back(sum / count);
  }
  return means;
}

ErrorRatio error_ratio(const std::vector<double>& error, const std::vector<double>& other) {
  double worst = std::numeric_limits<double>::quiet_NaN(), sum = 0, count = 0;
  for (std::size_t k = 0; k < error.size(); ++k) {
    const double ratio = error[k] / other[k];
    if (!std::isfinite(ratio)) continue;  // a joint whose error cannot be told
    worst = std::fmax(worst, ratio);
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
