#pragma once
/// A column of a log as a function of time. It has its own sample rate, and samples may be missing.

#include <algorithm>
#include <boost/math/interpolators/cubic_hermite.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

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
    std::nth_element(steps.begin(), steps.begin() + steps.size() / 2, steps.end());
    interval_ = steps[steps.size() / 2];
    between_.emplace(std::vector<double>(t_), std::vector<double>(x_), slopes());
  }

  /// True if there are enough samples to describe a motion and to interpolate.
  bool is_there() const { return t_.size() >= 4; }
  /// The usual time from a sample to the next, s.
  double interval() const { return interval_; }

  double at(double time) const {
    if (!is_there()) return x_.empty() ? 0 : x_.front();
    return (*between_)(std::clamp(time, t_.front(), t_.back()));
  }

  /// Time from the sample before to the one after; infinite before the first and after the last.
  double hole_at(double time) const {
    const auto after = std::lower_bound(t_.begin(), t_.end(), time);
    if (after != t_.end() && *after == time) return 0;
    if (after == t_.begin() || after == t_.end()) return std::numeric_limits<double>::infinity();
    return *after - after[-1];
  }

  /// Time to the nearest sample.
  double distance(double time) const {
    const auto after = std::lower_bound(t_.begin(), t_.end(), time);
    const double to_next = after == t_.end() ? std::numeric_limits<double>::infinity() : *after - time;
    return after == t_.begin() ? to_next : std::min(to_next, time - after[-1]);
  }

 private:
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

  std::vector<double> t_, x_;
  double interval_ = 0;
  std::optional<boost::math::interpolators::cubic_hermite<std::vector<double>>> between_;
};

}  // namespace halyard
