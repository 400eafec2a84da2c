#pragma once
/// A column of a log as a function of time. It has its own sample rate, and samples may be missing.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "diagnosis/record/record.h"
#include "model/statistics/quantile.h"

namespace halyard {

/// The available samples of a column, and their interpolation.
class SampledColumn {
 public:
  SampledColumn(const std::vector<double>& time, const std::vector<double>& x) {
    for (std::size_t i = 0; i < x.size(); ++i)
      if (std::isfinite(x[i])) t_.push_back(time[i]), x_.push_back(x[i]);
    if (!is_there()) return;
    std::vector<double> steps(t_.size() - 1);
    for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = t_[i + 1] - t_[i];
    interval_ = median(steps);
    usual_hole_ = middle_of_time(std::move(steps), interval_);
    slope_ = slopes();
  }

  /// True if there are enough samples to describe a motion and to interpolate.
  bool is_there() const { return t_.size() >= 4; }
  /// The usual time from a sample to the next, s.
  double interval() const { return interval_; }
  /// The time from a sample to the next in which half of all time lies, s: the interval, or the time from a burst of
  /// samples to the next burst.
  double usual_hole() const { return usual_hole_; }

  std::vector<SensorSample> samples() const {
    std::vector<SensorSample> all;
    for (std::size_t i = 0; i < t_.size(); ++i) all.push_back({t_[i], x_[i]});
    return all;
  }

  double at(double time) const {
    if (!is_there()) return x_.empty() ? 0 : x_.front();
    time = std::clamp(time, t_.front(), t_.back());
    const std::size_t i = sample_before(time);
    // The cubic Hermite polynomial between two samples.
    const double h = t_[i + 1] - t_[i], s = (time - t_[i]) / h, chord = (x_[i + 1] - x_[i]) / h;
    const double bend = slope_[i] + slope_[i + 1] - 2 * chord;
    return x_[i] + h * s * (slope_[i] + s * (3 * chord - 2 * slope_[i] - slope_[i + 1] + s * bend));
  }

  /// Time from the sample before to the one after; infinite before the first and after the last. 0 at a sample, and
  /// between the ends within a hundredth of an interval of one: the times of a grid differ from a log's by rounding.
  double hole_at(double time) const {
    constexpr double kAtSample = 0.01;
    const auto after = std::lower_bound(t_.begin(), t_.end(), time);
    if (after != t_.end() && *after == time) return 0;
    if (after == t_.begin() || after == t_.end()) return std::numeric_limits<double>::infinity();
    if (std::min(*after - time, time - after[-1]) <= kAtSample * interval_) return 0;
    return *after - after[-1];
  }

  /// Time to the nearest sample.
  double distance(double time) const {
    const auto after = std::lower_bound(t_.begin(), t_.end(), time);
    const double to_next = after == t_.end() ? std::numeric_limits<double>::infinity() : *after - time;
    return after == t_.begin() ? to_next : std::min(to_next, time - after[-1]);
  }

 private:
  /// The step in which the middle of all time lies if the steps follow each other by size.
  static double middle_of_time(std::vector<double> steps, double usual) {
    double all = 0, in_longer = 0, below = 0;
    for (const double step : steps) all += step, in_longer += step > 1.5 * usual ? step : 0;
    if (in_longer <= 0.5 * all) return usual;
    std::sort(steps.begin(), steps.end());
    const auto middle =
        std::find_if(steps.begin(), steps.end(), [&](double step) { return (below += step) > 0.5 * all; });
    return middle == steps.end() ? usual : *middle;
  }

  /// The sample at a time or the last one before it, but not the last of all. Samples are nearly even: its place is
  /// guessed, and searched for only if the guess is wrong.
  std::size_t sample_before(double time) const {
    const auto guess =
        static_cast<std::size_t>((time - t_.front()) / (t_.back() - t_.front()) * static_cast<double>(t_.size() - 1));
    const std::size_t last = t_.size() - 2, near = std::min(guess > 0 ? guess - 1 : 0, last);
    for (std::size_t i = near; i <= std::min(near + 2, last); ++i)
      if (t_[i] <= time && (time < t_[i + 1] || i == last)) return i;
    const auto after = std::upper_bound(t_.begin(), t_.end(), time);
    return std::min(static_cast<std::size_t>(after - t_.begin()) - 1, last);
  }

  /// Slope at each sample: that of the parabola through it and its neighbours; at the ends that of the chord.
  std::vector<double> slopes() const {
    const auto chord = [&](std::size_t i) { return (x_[i + 1] - x_[i]) / (t_[i + 1] - t_[i]); };
    std::vector<double> slope(t_.size());
    slope.front() = chord(0);
    slope.back() = chord(t_.size() - 2);
    for (std::size_t i = 1; i + 1 < t_.size(); ++i) {
      const double before = t_[i] - t_[i - 1], after = t_[i + 1] - t_[i];
      slope[i] = (after * chord(i - 1) + before * chord(i)) / (before + after);
    }
    return slope;
  }

  std::vector<double> t_, x_, slope_;
  double interval_ = 0, usual_hole_ = 0;
};

/// The step of a sensor that the model says nothing of: the smallest change that the record shows.
inline double smallest_step(const std::vector<SensorSample>& samples) {
  double step = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double d = std::abs(samples[i].value - samples[i - 1].value);
    if (d > 1e-12 && (step == 0 || d < step)) step = d;
  }
  return step;
}

}  // namespace halyard
