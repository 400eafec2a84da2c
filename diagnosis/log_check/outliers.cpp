#include "diagnosis/log_check/outliers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "diagnosis/log_check/robust.h"
#include "diagnosis/record/record.h"
#include "model/statistics/quantile.h"

namespace halyard {
namespace {

constexpr std::size_t kMostInARow = 3;
constexpr double kLongest = 5e-3;  ///< s, of several in a row
constexpr double kGoesOn = 0.2;    ///< r over d; a motion that turns round at once has 1/3

/// A reading, and the rows from first to last that have it.
struct Reading {
  double x, time;
  std::size_t first, last;
  std::size_t rows() const { return last - first + 1; }
};

/// Rows that follow each other and are equal count as one reading.
std::vector<Reading> changing_readings(const std::vector<double>& time, const std::vector<double>& column) {
  std::vector<Reading> all;
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (!std::isfinite(column[i])) continue;
    if (all.empty() || column[i] != all.back().x) all.push_back({column[i], time[i], i, i});
    all.back().last = i;
  }
  return all;
}

/// A sensor that is slower than the log repeats a reading in several rows; one at rest gives the same reading again.
std::vector<Reading> repeated_at_rest(const std::vector<double>& time, const std::vector<Reading>& changing) {
  std::vector<double> lengths;
  for (const Reading& r : changing) lengths.push_back(static_cast<double>(r.rows()));
  const double rows_a_reading = median(std::move(lengths));
  std::vector<Reading> all;
  for (const Reading& r : changing) {
    const auto times = std::max<std::size_t>(1, std::lround(static_cast<double>(r.rows()) / rows_a_reading));
    for (std::size_t i = 0; i < times; ++i) {
      const std::size_t first = r.first + r.rows() * i / times;
      all.push_back({r.x, time[first], first, r.first + r.rows() * (i + 1) / times - 1});
    }
  }
  return all;
}

/// The step of a rounded reading.
double smallest_step(const std::vector<Reading>& s) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < s.size(); ++i) smallest = std::min(smallest, std::abs(s[i].x - s[i - 1].x));
  return std::isfinite(smallest) ? smallest : 0;
}

/// From the neighbours' median, which a steady motion does not change, and from their mean, which shows the noise.
double usual_distance(const std::vector<Reading>& s) {
  std::vector<double> x, from_median, from_mean;
  for (const Reading& r : s) x.push_back(r.x);
  for (std::size_t i = 2; i + 2 < x.size(); ++i) {
    from_median.push_back(std::abs(x[i] - median({x[i - 2], x[i - 1], x[i], x[i + 1], x[i + 2]})));
    from_mean.push_back(std::abs(x[i] - 0.5 * (x[i - 1] + x[i + 1])));
  }
  // Quantiles that are one and two standard deviations of Gaussian noise. The higher ones count where most differences
  // of a rounded reading are 0. An outlier is in three of from_mean, but in one of from_median: 4 % of outliers do no
  // harm.
  return std::max({smallest_step(s), 1e-6 * spread(x), 1.48 * median(from_median), 1.48 * median(from_mean),
                   quantile(from_mean, 0.68), 0.5 * quantile(from_mean, 0.85), 0.5 * quantile(from_median, 0.95)});
}

/// Distances of the readings i..i+m-1 from the line through the two before and the two after them.
struct Excursion {
  double least = std::numeric_limits<double>::infinity();
  double largest = 0;    ///< with its sign
  double neighbour = 0;  ///< largest distance of the four
};

/// at(j): where reading j lies on the line.
template <class At>
Excursion excursion_along(const std::vector<Reading>& s, std::size_t i, std::size_t m, const At& at) {
  const std::array<std::size_t, 4> around = {i - 2, i - 1, i + m, i + m + 1};
  double middle = 0, mean = 0, slope = 0, square = 0;
  for (const std::size_t j : around) middle += 0.25 * at(j);
  for (const std::size_t j : around) {
    const double from_middle = at(j) - middle;
    mean += 0.25 * s[j].x;
    slope += from_middle * s[j].x;
    square += from_middle * from_middle;
  }
  slope /= square;
  const auto distance = [&](std::size_t j) { return s[j].x - mean - slope * (at(j) - middle); };
  Excursion e;
  for (const std::size_t j : around) e.neighbour = std::max(e.neighbour, std::abs(distance(j)));
  for (std::size_t j = i; j < i + m; ++j) {
    e.least = std::min(e.least, std::abs(distance(j)));
    if (std::abs(distance(j)) > std::abs(e.largest)) e.largest = distance(j);
  }
  return e;
}

/// Along the times and along the numbers of the readings: rows may be lost, and even readings may have uneven times. A
/// reading near one of the two lines is none.
Excursion excursion_of(const std::vector<Reading>& s, std::size_t i, std::size_t m) {
  const Excursion even = excursion_along(s, i, m, [](std::size_t j) { return static_cast<double>(j); });
  const Excursion timed = excursion_along(s, i, m, [&](std::size_t j) { return s[j].time - s[i].time; });
  Excursion e = timed.neighbour < even.neighbour ? timed : even;
  e.least = std::min(timed.least, even.least);
  return e;
}

}  // namespace

Outliers find_outliers(const std::vector<double>& time, const std::vector<double>& column, double factor,
                       double least) {
  Outliers found;
  const std::vector<Reading> changing = changing_readings(time, column);
  if (changing.size() < 5) return found;
  found.usual = usual_distance(changing);  // a long rest does not show what is usual
  if (found.usual == 0) return found;
  least = std::max(least, factor * found.usual);
  const std::vector<Reading> s = repeated_at_rest(time, changing);
  for (std::size_t i = 2; i + 2 < s.size(); ++i)
    for (std::size_t m = 1; m <= kMostInARow && i + m + 1 < s.size(); ++m) {
      if (m > 1 && time[s[i + m].first] - time[s[i].first] > kLongest) break;
      const Excursion e = excursion_of(s, i, m);
      if (e.least < least || e.neighbour > kGoesOn * e.least) continue;
      found.readings += m;
      if (std::abs(e.largest) > std::abs(found.largest)) found.largest = e.largest, found.when = time[s[i].first];
      for (std::size_t row = s[i].first; row <= s[i + m - 1].last; ++row)
        if (std::isfinite(column[row])) found.rows.push_back(row);
      i += m;
      break;
    }
  return found;
}

Outliers find_torque_outliers(const Log& log, int k, const OutlierRule& rule) {
  const std::vector<double>& torque = log.motor_torque[k];
  return find_outliers(log.time, torque, rule.factor, rule.torque_share * spread(torque));
}

Log without_outliers(Log log, const OutlierRule& rule) {
  constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  const double reach = 4 / (2 * std::numbers::pi * RecordOptions{}.motion_hz);
  for (int k = 0; k < log.n_joints; ++k) {
    for (Signals* signal : {&log.motor_position, &log.joint_position})
      for (const std::size_t row : find_outliers(log.time, (*signal)[k], rule.factor).rows)
        (*signal)[k][row] = kMissing;
    std::vector<double>& torque = log.motor_torque[k];
    for (const std::size_t row : find_torque_outliers(log, k, rule).rows) {
      const auto begin = std::ranges::lower_bound(log.time, log.time[row] - reach);
      for (auto i = static_cast<std::size_t>(begin - log.time.begin());
           i < log.size() && log.time[i] <= log.time[row] + reach; ++i)
        torque[i] = kMissing;
    }
  }
  return log;
}

}  // namespace halyard
