#include "diagnosis/holdout/adoption.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/judgement/final_fit.h"
#include "diagnosis/record/common_clock.h"
#include "diagnosis/search_space.h"

namespace halyard {
namespace {

/// Predicts the hold-out with a revised model, and judges its errors.
class Trier {
 public:
  Trier(const AdoptionTask& task, HoldOut& joints, HoldOut& torques)
      : task_(task), joints_(joints), torques_(torques), given_(task.given.effects.size()) {}

  /// HoldOut::after by the fit; returns its absent events.
  std::vector<std::size_t> predict(const Hypothesis& revised) {
    std::vector<std::size_t> absent;
    Hypothesis on_holdout = revised;
    double least = error_of(on_holdout);
    bool is_predicted = true;
    for (std::size_t e = on_holdout.effects.size(); task_.has_own_log && e-- > given_;) {
      if (!is_event(on_holdout.effects[e], task_.given.nominal)) continue;
      const Hypothesis without = without_effect(on_holdout, e);
      const double error = error_of(without);
      is_predicted = error < least;
      if (!is_predicted) continue;
      absent.push_back(e);
      on_holdout = without;
      least = error;
    }
    if (!is_predicted) error_of(on_holdout);
    return absent;
  }

  std::vector<int> worse(const std::vector<double>& floor) const {
    return worse_joints(task_.given, joints_, torques_, floor);
  }

 private:
  double error_of(const Hypothesis& on_common_clock) {
    const Hypothesis h = on_holdout_clock(task_, on_common_clock);
    for (HoldOut* view : {&joints_, &torques_}) view->after = predict_all(view->records, h);
    return error_over_floors(task_.given, joints_, torques_, &HoldOut::after, task_.evidence.floor());
  }

  const AdoptionTask& task_;
  HoldOut &joints_, &torques_;
  std::size_t given_;
};

/// Numbers of the fit, as indices of its parameters, that move one of these joints on the hold-out by more than a tenth
/// of its error, and of whose tolerance, as a variance, the training leaves more than a quarter.
class WeakNumbers {
 public:
  WeakNumbers(const Fit& fit, const Hypothesis& on_holdout, const HoldOut& joints, const HoldOut& torques) {
    std::vector<Hypothesis> all = {on_holdout};
    for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
      const FitParameter& p = fit.parameters[i];
      const auto at = static_cast<Eigen::Index>(i);
      if (p.effect || fit.covariance(at, at) < kLeft * p.scale * p.scale || fit.value[i] == p.nominal) continue;
      all.push_back(on_holdout);
      set_parameter(all.back(), p, p.nominal);
      number_.push_back(i);
    }
    const int n = on_holdout.nominal.n;
    error_.assign(2 * static_cast<std::size_t>(n), 0);
    moved_.assign(number_.size(), error_);
    add(joints.records, all, n, 2 * n);
    add(torques.records, all, 0, n);
  }

  /// Those that move the position of one of these joints; if there are none but those of `known`, also those that move
  /// the torque of its motor.
  std::vector<std::size_t> of(const std::vector<int>& worse, const std::vector<std::size_t>& known) const {
    const std::size_t n = error_.size() / 2;
    std::vector<std::size_t> weak;
    for (const bool with_torques : {false, true}) {
      weak.clear();
      for (std::size_t i = 0; i < number_.size(); ++i) {
        const auto moves = [&](std::size_t c) { return moved_[i][c] > kMoves * kMoves * error_[c]; };
        const auto is_weak_for = [&](int k) { return moves(n + k) || (with_torques && moves(k)); };
        const bool is_known = std::ranges::find(known, number_[i]) != known.end();
        if (is_known || std::ranges::any_of(worse, is_weak_for)) weak.push_back(number_[i]);
      }
      if (weak.size() > known.size()) break;
    }
    return weak;
  }

 private:
  static constexpr double kLeft = 0.25, kMoves = 0.1;

  /// Adds to the sums of squares of the channels first .. end - 1.
  void add(const std::vector<Record>& records, const std::vector<Hypothesis>& all, int first, int end) {
    constexpr int kStride = 10;  // residuals change slowly with the model's numbers
    for (const Record& record : records) {
      const std::vector<Residuals> e = predict(record, all, kStride);
      for (int c = first; c < end; ++c)
        for (std::size_t i = 0; i < e[0].channel[c].size(); ++i) {
          const double error = e[0].channel[c][i];
          if (std::isnan(error)) continue;
          error_[c] += error * error;
          for (std::size_t p = 0; p < number_.size(); ++p)
            if (e[p + 1].finite) moved_[p][c] += std::pow(e[p + 1].channel[c][i] - error, 2);
        }
    }
  }

  std::vector<std::size_t> number_;
  std::vector<double> error_;               ///< [2n] squares of the errors
  std::vector<std::vector<double>> moved_;  ///< [number][2n] squares of what it moves
};

/// Gives back the weak numbers of the joints that are worse until none is. False if there are no more of them.
bool give_weak_numbers_back(const AdoptionTask& task, Trier& trier, const HoldOut& joints, const HoldOut& torques,
                            Adoption& a) {
  const Fit before = a.revised.fit;
  Hypothesis on_holdout = before.hypothesis;
  for (const std::size_t e : a.absent_events) on_holdout = without_effect(on_holdout, e);
  const WeakNumbers weak(before, on_holdout_clock(task, on_holdout), joints, torques);
  std::vector<int> worse = a.worse;
  for (std::vector<std::size_t> returned;;) {
    const std::vector<std::size_t> all = weak.of(worse, returned);
    if (all.size() == returned.size()) return false;
    returned = all;
    const Fit fit = with_numbers_given(task.whole, before, returned);
    if (!fit.usable) return false;
    const auto absent = trier.predict(fit.hypothesis);
    const std::vector<int> still = trier.worse(task.evidence.floor());
    if (still.empty()) {
      a = {{fit, changed_numbers(task.whole, task.tolerated, fit)}, {}, absent};
      return true;
    }
    for (const int k : still)
      if (std::ranges::find(worse, k) == worse.end()) worse.push_back(k);
  }
}

}  // namespace

Adoption adopted_on_holdout(const AdoptionTask& task, Revised revised, HoldOut& joints, HoldOut& torques) {
  Trier trier(task, joints, torques);
  Adoption a{std::move(revised), {}, {}};
  a.absent_events = trier.predict(a.revised.fit.hypothesis);
  if (a.revised.fit.hypothesis.effects.size() == task.given.effects.size() && a.revised.changed.empty()) return a;
  a.worse = trier.worse(task.evidence.floor());
  if (a.worse.empty() || give_weak_numbers_back(task, trier, joints, torques, a)) return a;
  // What numbers explain within their tolerances is not unexplained because other data want others.
  if (const Fit fit = with_given_motion(task.whole, task.tolerated, a.revised.fit); fit.usable) {
    a.revised = {fit, changed_numbers(task.whole, task.tolerated, fit)};
    a.absent_events = trier.predict(fit.hypothesis);
    a.worse = trier.worse(holdout_floors(task.evidence, task.tolerated, joints, torques));
  }
  if (a.worse.empty()) return a;
  a.absent_events.clear();
  for (HoldOut* view : {&joints, &torques}) view->after = view->before;
  return a;
}

Hypothesis on_holdout_clock(const AdoptionTask& task, const Hypothesis& on_common_clock) {
  if (!task.has_own_log) return on_common_clock;
  return on_clocks_of_their_logs(on_common_clock, task.given.effects.size(), task.given.nominal,
                                 task.evidence.records());
}

}  // namespace halyard
