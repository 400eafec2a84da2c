#include "bench/diagnosis/trial/take_over.h"

#include <cmath>

#include "bench/diagnosis/trial/informed_fit.h"
#include "diagnosis/diagnosis_details.h"

namespace halyard::blind {
namespace {

Named named_of(const NamedEffect& e, int joints) {
  Named named{.place = place_of(e.effect, joints), .probability = e.probability, .alternatives = {}, .parameters = {}};
  for (const halyard::Alternative& a : e.alternatives)
    named.alternatives.push_back({place_of(a.effect, joints), a.probability, a.in_set});
  for (const Estimated& p : e.parameters) named.parameters.push_back({p.name, p.value, p.lower, p.upper});
  return named;
}

/// Squares of one joint's errors, one entry for each second of each record in which the joint was read.
class SquaredErrors {
 public:
  void add(double error, bool new_second) {
    if (new_second || sum_.empty()) sum_.push_back(0), count_.push_back(0);
    sum_.back() += error * error;
    count_.back() += 1;
  }
  double rms() const {
    double sum = 0, count = 0;
    for (std::size_t b = 0; b < sum_.size(); ++b) sum += sum_[b], count += count_[b];
    return std::sqrt(sum / count);
  }
  /// Mean of the blocks' differences over its standard deviation; 0 for fewer than two blocks or no difference.
  double rise_above(const SquaredErrors& other) const {
    const auto n = static_cast<double>(sum_.size());
    double mean = 0, square = 0;
    for (std::size_t b = 0; b < sum_.size(); ++b) mean += (sum_[b] / count_[b] - other.sum_[b] / other.count_[b]) / n;
    for (std::size_t b = 0; b < sum_.size(); ++b)
      square += std::pow(sum_[b] / count_[b] - other.sum_[b] / other.count_[b] - mean, 2);
    return square > 0 ? mean / std::sqrt(square / (n - 1) / n) : 0;
  }

 private:
  std::vector<double> sum_, count_;
};

/// Of the models on the records of a hold-out.
HoldOutErrors hold_out_errors(const std::vector<Record>& records, const Diagnosis& d, const ArmModel& robot,
                              const std::optional<ArmModel>& informed) {
  HoldOutErrors errors;
  const auto by = [&](const ArmModel& model) { return predict_all(records, {model.nominal, model.effects}); };
  const std::vector<FullPrediction> given = by(d.given), revised = by(d.revised_on_holdout()), truth = by(robot),
                                    best = informed ? by(*informed) : std::vector<FullPrediction>();
  for (int k = 0; k < robot.n(); ++k) {
    SquaredErrors before, after, true_model, of_informed;
    for (std::size_t r = 0; r < records.size(); ++r) {
      const Record& record = records[r];
      long second = -1;
      for (std::size_t i = 0; record.has_joint(k) && i < record.size; ++i) {
        const double q = record.joint_raw[k][i], of_truth = q - truth[r].joint_reading[k][i];
        if (!(record.joint_valid[k][i] > 0) || std::isnan(of_truth)) continue;
        const long now = std::lround(std::floor(record.time(i)));
        before.add(q - given[r].joint_reading[k][i], now != second);
        after.add(q - revised[r].joint_reading[k][i], now != second);
        true_model.add(of_truth, now != second);
        if (informed) of_informed.add(q - best[r].joint_reading[k][i], now != second);
        second = now;
      }
    }
    errors.before.push_back(before.rms());
    errors.after.push_back(after.rms());
    errors.true_model.push_back(true_model.rms());
    if (informed) errors.informed.push_back(of_informed.rms());
    errors.rise.push_back(after.rise_above(before));
  }
  return errors;
}

}  // namespace

void take_over(const Diagnosis& d, const Recording& recording, Result& r) {
  const ArmModel& robot = recording.robot;
  r.verdict = verdict_word(d.verdict);
  for (const NamedEffect& e : d.effects) r.named.push_back(named_of(e, robot.n()));
  for (const Unexplained& u : d.unexplained) r.unexplained.push_back(u.joint + 1);
  r.probability_clean = d.probability_clean;
  r.probability_none = d.probability_none;
  const std::optional<ArmModel> informed = informed_fit(d.given, recording, r.situation.off);
  r.holdout = hold_out_errors(d.details->joint_view.records, d, robot, informed);
  const DiagnosisData sensed = diagnosis_data(d.given, {recording.training}, recording.sensed_holdout, d.given);
  r.sensed_holdout = hold_out_errors(sensed.joint_view.records, d, robot, informed);
  r.interval_coverage = d.joint_interval.coverage;
}

}  // namespace halyard::blind
