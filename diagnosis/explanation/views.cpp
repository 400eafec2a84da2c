#include "diagnosis/explanation/views.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "model/statistics/distributions.h"
#include "model/statistics/quantile.h"

namespace halyard {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kMostKnots = 24;         ///< of a turn; half of it otherwise
constexpr int kTimeKnots = 6;          ///< what changes in time does so slowly, or once
constexpr double kSamplesPerKnot = 5;  ///< independent ones
constexpr double kTold = 0.2;          ///< share of a mean square that is worth a view
constexpr double kHighestOrder = 24;
constexpr double kBand = 20;  ///< Hz; residuals have nothing above

constexpr std::array kAbscissae = {
    Abscissa::constant, Abscissa::direction,   Abscissa::joint_position, Abscissa::rate, Abscissa::load,
    Abscissa::stretch,  Abscissa::motor_angle, Abscissa::capstan_angle,  Abscissa::time, Abscissa::other_residual};

bool is_angle(Abscissa a) { return a == Abscissa::motor_angle || a == Abscissa::capstan_angle; }
bool may_loop(Abscissa a) { return a == Abscissa::joint_position || a == Abscissa::load || a == Abscissa::stretch; }

struct Moments {
  double n = 0, mean = 0, square = 0;
  double variance() const { return std::max(0.0, square - mean * mean); }
};

Moments moments(const std::vector<double>& y) {
  Moments m;
  for (const double v : y)
    if (std::isfinite(v)) m.n += 1, m.mean += v, m.square += v * v;
  if (m.n > 0) m.mean /= m.n, m.square /= m.n;
  return m;
}

/// Every so many samples, that at most so many are left: long logs say the same many times.
std::vector<double> thinned(const std::vector<double>& x) {
  constexpr std::size_t kMost = 8000;
  const std::size_t step = x.size() / kMost + 1;
  std::vector<double> some;
  for (std::size_t i = 0; i < x.size(); i += step) some.push_back(x[i]);
  return some;
}

/// Autocovariance at a lag, over the samples that are there.
double autocovariance(const std::vector<double>& y, double mean, std::size_t lag) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i + lag < y.size(); ++i) {
    const double product = (y[i] - mean) * (y[i + lag] - mean);
    if (std::isfinite(product)) sum += product, count += 1;
  }
  return count > 0 ? sum / count : 0;
}

/// N of the header; x empty: of the residual's mean.
double independent_samples(const std::vector<double>& residual, const std::vector<double>& abscissa, bool wrapped) {
  const std::vector<double> y = thinned(residual);
  std::vector<double> x = thinned(abscissa);
  if (wrapped)
    for (double& v : x) v = std::cos(v);
  const Moments m_y = moments(y), m_x = moments(x);
  const double variance_y = m_y.variance(), variance_x = m_x.variance();
  if (!(variance_y > 0)) return m_y.n;
  double area = 0.5;
  for (std::size_t lag = 1; lag < y.size() / 4; ++lag) {
    const double rho_y = autocovariance(y, m_y.mean, lag) / variance_y;
    const double rho_x = variance_x > 0 ? autocovariance(x, m_x.mean, lag) / variance_x : 1;
    if (rho_y <= 0 || rho_x <= 0) break;
    area += rho_y * rho_x;
  }
  return m_y.n / (2 * area);
}

double extent_of(const std::vector<double>& x) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double v : x)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  return std::max(0.0, high - low);
}

const std::vector<double>& direction_of(const ResidualSignals& s, ResidualKind residual) {
  return residual == ResidualKind::motor_torque ? s.motor_direction : s.joint_direction;
}

int most_knots(const View& v) {
  return is_angle(v.abscissa) ? kMostKnots : v.abscissa == Abscissa::time ? kTimeKnots : kMostKnots / 2;
}

CurveFit curve_of(const ResidualSignals& s, const View& v, int knots) {
  std::vector<double> x = abscissa_of(s, v.residual, v.abscissa);
  for (double& value : x) value = within_turn(v.abscissa, value);
  return fit_curve(x, s.of(v.residual), v.loop ? direction_of(s, v.residual) : std::vector<double>{}, knots,
                   is_angle(v.abscissa) ? kTurn : 0);
}

struct Explained {
  double share = 0, chance = 0, swing = 0;
};

Explained explained(const ResidualSignals& s, const View& v) {
  const std::vector<double>& y = s.of(v.residual);
  if (v.abscissa == Abscissa::constant) {
    const Moments m = moments(y);
    const double n = independent_samples(y, {}, false);
    if (!(m.square > 0) || n <= 1) return {};
    const double share = m.mean * m.mean / m.square;
    // A mean of three times its own deviation.
    return {std::max(0.0, share - (1 - share) / (n - 1)), 9 / (9 + n), std::abs(m.mean)};
  }
  const double n = independent_samples(y, abscissa_of(s, v.residual, v.abscissa), is_angle(v.abscissa));
  const int knots = static_cast<int>(n / kSamplesPerKnot / (v.loop ? 2 : 1));
  const CurveFit fit = curve_of(s, v, std::clamp(knots, 3, most_knots(v)));
  if (fit.numbers < 2 || n <= fit.numbers) return {};
  const auto less_chance = [&](double r_squared) { return 1 - (1 - r_squared) * (n - 1) / (n - fit.numbers); };
  // Of noise R² has a beta distribution (Cramér 1946): as rarely beyond this as a normal number beyond 3 deviations.
  constexpr double kRare = 0.00135;
  const double of_noise = beta_quantile(0.5 * (fit.numbers - 1), 0.5 * (n - fit.numbers), kRare);
  return {std::max(0.0, less_chance(fit.explained)), std::max(0.0, less_chance(of_noise)), fit.swing()};
}

bool is_told(const ResidualSignals& s, const View& v) {
  const std::vector<double>& x = abscissa_of(s, v.residual, v.abscissa);
  if (s.of(v.residual).empty() || x.empty()) return false;
  if (v.abscissa == Abscissa::stretch && v.residual == ResidualKind::transmission) return false;  // it is the stretch
  if (is_angle(v.abscissa)) return extent_of(x) > 2 * kTurn;
  return v.abscissa == Abscissa::constant || extent_of(x) > 0;
}

/// Abscissae that are much the same thing.
int group(Abscissa a) {
  switch (a) {
    case Abscissa::direction: return static_cast<int>(Abscissa::rate);
    case Abscissa::stretch: return static_cast<int>(Abscissa::load);
    case Abscissa::capstan_angle: return static_cast<int>(Abscissa::motor_angle);
    default: return static_cast<int>(a);
  }
}

/// The best by `share`, each over another abscissa; the others are at least half as telling as the first. `before`: for
/// lines over angles.
template <class Share>
std::vector<View> best_views(std::vector<View> views, const ResidualSignals& before, const Share& share) {
  constexpr double kMostOfIt = 0.8;
  const auto constant = [&](const View& v) { return v.abscissa == Abscissa::constant; };
  // What falls onto a curve almost wholly and is gone with the effect needs no statistics, however short the record.
  constexpr double kWholly = 0.9;
  std::erase_if(views, [&](const View& v) {
    const bool by_chance = v.explained_before < v.chance && v.removed() < kWholly;
    return share(v) < (constant(v) ? kMostOfIt : kTold) || by_chance;
  });
  std::stable_sort(views.begin(), views.end(), [&](const View& a, const View& b) { return share(a) > share(b); });
  std::stable_partition(views.begin(), views.end(), constant);
  std::vector<View> best;
  double most = 0;
  for (const View& v : views) {
    if (best.size() == 3 || share(v) < 0.5 * most) break;
    if (std::any_of(best.begin(), best.end(), [&](const View& b) { return group(b.abscissa) == group(v.abscissa); }))
      continue;
    if (!constant(v)) most = std::max(most, share(v));
    best.push_back(v);
  }
  for (View& v : best)
    if (is_angle(v.abscissa)) v.line = strongest_line(angle_spectrum(before, v.residual, v.abscissa));
  return best;
}

}  // namespace

double within_turn(Abscissa abscissa, double x) { return is_angle(abscissa) ? x - kTurn * std::floor(x / kTurn) : x; }

const std::vector<double>& abscissa_of(const ResidualSignals& s, ResidualKind residual, Abscissa abscissa) {
  const bool motor = residual == ResidualKind::motor_torque;
  switch (abscissa) {
    case Abscissa::constant:
    case Abscissa::time: return s.time;
    case Abscissa::direction: return direction_of(s, residual);
    case Abscissa::joint_position: return s.joint_position;
    case Abscissa::rate: return motor ? s.motor_rate : s.joint_rate;
    case Abscissa::load: return s.load;
    case Abscissa::stretch: return s.stretch;
    case Abscissa::motor_angle: return s.motor_angle;
    case Abscissa::capstan_angle: return s.capstan_angle;
    case Abscissa::other_residual: break;
  }
  return s.of(motor ? ResidualKind::joint_position : ResidualKind::motor_torque);
}

std::vector<Curve> view_curves(const ResidualSignals& s, const View& v) {
  if (v.abscissa == Abscissa::constant) return {};
  return curve_of(s, v, most_knots(v)).curves;
}

std::vector<View> all_views(const ResidualSignals& before, const ResidualSignals& after) {
  std::vector<View> views;
  for (const ResidualKind kind : kResidualKinds) {
    if (before.of(kind).empty() || after.of(kind).empty()) continue;
    // The same abscissa for both, but for the other residual, which is another one.
    ResidualSignals shared = after;
    shared.residual = before.residual;
    const Moments m_before = moments(before.of(kind)), m_after = moments(after.of(kind));
    if (!(m_before.variance() > 0)) continue;
    const auto look = [&](Abscissa abscissa, bool loop) {
      View v{.residual = kind, .abscissa = abscissa, .loop = loop};
      const Explained b = explained(shared, v), a = explained(after, v);
      v.explained_before = b.share, v.explained_after = a.share;
      v.chance = b.chance;
      v.swing =
          abscissa == Abscissa::constant ? b.swing : curve_of(shared, v, most_knots(v)).swing();  // as it is drawn
      v.left = m_after.square / m_before.square;
      v.variance_left = abscissa == Abscissa::constant ? v.left : m_after.variance() / m_before.variance();
      return v;
    };
    double of_direction = 0;
    for (const Abscissa abscissa : kAbscissae) {
      if (!is_told(after, View{.residual = kind, .abscissa = abscissa}) ||
          !is_told(shared, View{.residual = kind, .abscissa = abscissa}))
        continue;
      views.push_back(look(abscissa, false));
      const View single = views.back();
      if (abscissa == Abscissa::direction) of_direction = single.explained_before;
      if (!may_loop(abscissa)) continue;
      // A loop has to say more than its abscissa or the direction alone.
      constexpr double kMore = 0.1;
      const View loop = look(abscissa, true);
      if (loop.explained_before > std::max(single.explained_before, of_direction) + kMore) views.push_back(loop);
    }
  }
  return views;
}

std::vector<View> telling_views(const ResidualSignals& before, const ResidualSignals& after) {
  return best_views(all_views(before, after), before, [](const View& v) { return v.removed(); });
}

std::vector<View> telling_views(const ResidualSignals& rest) {
  std::vector<View> views = all_views(rest, rest);
  std::erase_if(views, [](const View& v) {
    return v.residual == ResidualKind::transmission || v.residual == ResidualKind::joint_torque;
  });
  return best_views(std::move(views), rest, [](const View& v) { return v.explained_before; });
}

Spectrum angle_spectrum(const ResidualSignals& s, ResidualKind residual, Abscissa angle) {
  const std::vector<double>&x = abscissa_of(s, residual, angle), &y = s.of(residual);
  const double turns = extent_of(x) / kTurn;
  if (y.empty() || turns < 2) return {};
  // A line whose frequency in time is beyond the residual's band at the usual rate cannot be seen.
  std::vector<double> rate;
  for (std::size_t i = 1; i < x.size(); ++i) rate.push_back(std::abs(x[i] - x[i - 1]) / s.dt);
  const double usual = median(std::move(rate)) / kTurn;
  const double highest = usual > 0 ? std::min(kHighestOrder, kBand / usual) : kHighestOrder;
  std::vector<double> in_turns = thinned(x);
  for (double& v : in_turns) v /= kTurn;
  // Four frequencies to a resolution cell.
  return spectrum(in_turns, thinned(y), std::max(0.5, 2 / turns), highest,
                  std::max(0.25 / turns, kHighestOrder / 4000));
}

}  // namespace halyard
