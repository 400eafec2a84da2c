#include "diagnosis/views.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace halyard {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kMostBins = 24;
constexpr int kTimeBins = 8;           ///< what changes in time does so slowly, or once
constexpr double kSamplesPerBin = 3;   ///< independent ones
constexpr double kTold = 0.2;          ///< share of a mean square that is worth a view
constexpr double kHighestOrder = 24;
constexpr double kBand = 20;           ///< Hz; residuals have nothing above

constexpr std::array kAbscissae = {
    Abscissa::constant,    Abscissa::direction,     Abscissa::joint_position, Abscissa::rate, Abscissa::load,
    Abscissa::stretch,     Abscissa::motor_angle,   Abscissa::capstan_angle,  Abscissa::time, Abscissa::other_residual};

bool is_angle(Abscissa a) { return a == Abscissa::motor_angle || a == Abscissa::capstan_angle; }
bool may_loop(Abscissa a) { return a == Abscissa::joint_position || a == Abscissa::load || a == Abscissa::stretch; }

struct Moments { double n = 0, mean = 0, square = 0; };

Moments moments(const std::vector<double>& y) {
  Moments m;
  for (const double v : y)
    if (std::isfinite(v)) m.n += 1, m.mean += v, m.square += v * v;
  if (m.n > 0) m.mean /= m.n, m.square /= m.n;
  return m;
}

/// Samples over twice the area of the autocorrelation up to its first zero.
double independent_samples(const std::vector<double>& y, const Moments& m) {
  const double variance = m.square - m.mean * m.mean;
  if (!(variance > 0)) return m.n;
  double area = 0.5;
  for (std::size_t lag = 1; lag < y.size() / 4; ++lag) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i + lag < y.size(); ++i) {
      const double product = (y[i] - m.mean) * (y[i + lag] - m.mean);
      if (std::isfinite(product)) sum += product, count += 1;
    }
    if (count == 0 || sum <= 0) break;
    area += sum / count / variance;
  }
  return m.n / (2 * area);
}

/// Cells of an abscissa: the cell of each sample, -1 where there is none.
struct Cells {
  std::vector<int> of;
  int count = 0;
};

double range_of(const std::vector<double>& x) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double v : x)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  return std::max(0.0, high - low);
}

/// Bins of equal population; of equal width over a turn.
Cells bins(const std::vector<double>& x, const std::vector<double>& y, Abscissa abscissa, int count) {
  Cells cells{std::vector<int>(x.size(), -1), count};
  std::vector<double> edges;
  if (!is_angle(abscissa)) {
    std::vector<double> sorted;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (std::isfinite(x[i]) && std::isfinite(y[i])) sorted.push_back(x[i]);
    std::sort(sorted.begin(), sorted.end());
    for (int b = 1; b < count && !sorted.empty(); ++b) edges.push_back(sorted[sorted.size() * b / count]);
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
    cells.of[i] = is_angle(abscissa)
                      ? std::min(count - 1, static_cast<int>(within_turn(abscissa, x[i]) / kTurn * count))
                      : static_cast<int>(std::upper_bound(edges.begin(), edges.end(), x[i]) - edges.begin());
  }
  return cells;
}

const std::vector<double>& direction_of(const ResidualSignals& s, ResidualKind residual) {
  return residual == ResidualKind::motor_torque ? s.motor_direction : s.joint_direction;
}

/// The cells of a view, `independent` samples of the residual y allowing for so many.
Cells cells_of(const ResidualSignals& s, const View& view, const std::vector<double>& y, double independent) {
  if (view.abscissa == Abscissa::constant) return {};
  const std::vector<double>& direction = direction_of(s, view.residual);
  Cells cells;
  if (view.abscissa == Abscissa::direction) {
    cells = {std::vector<int>(y.size(), -1), 2};
    for (std::size_t i = 0; i < y.size(); ++i)
      if (std::isfinite(y[i])) cells.of[i] = direction[i] > 0;
    return cells;
  }
  const int most = view.abscissa == Abscissa::time ? kTimeBins : view.loop ? kMostBins / 2 : kMostBins;
  const int count = std::clamp(static_cast<int>(independent / kSamplesPerBin / (view.loop ? 2 : 1)), 3, most);
  cells = bins(abscissa_of(s, view.residual, view.abscissa), y, view.abscissa, count);
  if (view.loop) {
    for (std::size_t i = 0; i < y.size(); ++i)
      if (cells.of[i] >= 0 && direction[i] > 0) cells.of[i] += count;
    cells.count = 2 * count;
  }
  return cells;
}

struct Explained {
  double share = 0, chance = 0, swing = 0;
};

/// Means and populations of cells.
std::pair<std::vector<double>, std::vector<double>> cell_means(const std::vector<double>& y, const Cells& cells) {
  std::vector<double> n(cells.count, 0), mean(cells.count, 0);
  for (std::size_t i = 0; i < y.size(); ++i)
    if (cells.of[i] >= 0) n[cells.of[i]] += 1, mean[cells.of[i]] += y[i];
  for (int b = 0; b < cells.count; ++b)
    if (n[b] > 0) mean[b] /= n[b];
  return {mean, n};
}

Explained explained(const ResidualSignals& s, const View& view, const Moments& all, double independent) {
  const std::vector<double>& y = s.of(view.residual);
  if (!(all.square > 0)) return {};
  if (view.abscissa == Abscissa::constant)
    return {std::max(0.0, all.mean * all.mean / all.square - 1 / independent), 9 / independent, std::abs(all.mean)};
  const Cells cells = cells_of(s, view, y, independent);
  const auto [mean, n] = cell_means(y, cells);
  double between = 0, within = 0, low = std::numeric_limits<double>::infinity(), high = -low, samples = 0, centre = 0;
  for (int b = 0; b < cells.count; ++b) samples += n[b], centre += n[b] * mean[b];
  if (samples == 0) return {};
  centre /= samples;
  int used = 0;
  for (int b = 0; b < cells.count; ++b) {
    if (n[b] == 0) continue;
    between += n[b] * (mean[b] - centre) * (mean[b] - centre);
    ++used;
    // A bin of few samples does not tell how far the curve goes.
    if (n[b] > 0.2 * samples / cells.count) low = std::min(low, mean[b]), high = std::max(high, mean[b]);
  }
  for (std::size_t i = 0; i < y.size(); ++i)
    if (cells.of[i] >= 0) within += (y[i] - mean[cells.of[i]]) * (y[i] - mean[cells.of[i]]);
  if (used < 2 || independent <= used || !(between + within > 0)) return {};
  const double eta_square = between / (between + within);
  const double beyond_chance = 1 - (1 - eta_square) * (independent - 1) / (independent - used);
  // Under the null hypothesis the share scatters by sqrt(2 (B - 1)) / N: three times that is beyond chance.
  return {std::max(0.0, beyond_chance) * (between + within) / samples / all.square,
          3 * std::sqrt(2.0 * (used - 1)) / independent, high - low};
}

bool is_told(const ResidualSignals& s, const View& v) {
  const std::vector<double>& x = abscissa_of(s, v.residual, v.abscissa);
  if (s.of(v.residual).empty() || x.empty()) return false;
  if (v.abscissa == Abscissa::stretch && v.residual == ResidualKind::transmission) return false;   // it is the stretch
  if (is_angle(v.abscissa)) return range_of(x) > 2 * kTurn;
  return v.abscissa == Abscissa::constant || range_of(x) > 0;
}

/// Abscissae that are much the same thing.
int group(Abscissa a) {
  switch (a) {
    case Abscissa::stretch: return static_cast<int>(Abscissa::load);
    case Abscissa::capstan_angle: return static_cast<int>(Abscissa::motor_angle);
    default: return static_cast<int>(a);
  }
}

/// The best by `share`, each over another abscissa; the others are at least half as telling as the first.
template <class Share>
std::vector<View> best_views(std::vector<View> views, const Share& share) {
  std::stable_sort(views.begin(), views.end(), [&](const View& a, const View& b) { return share(a) > share(b); });
  std::vector<View> best;
  for (const View& v : views) {
    if (best.size() == 3 || share(v) < kTold || share(v) < v.chance) continue;
    if (!best.empty() && share(v) < 0.5 * share(best.front())) break;
    if (std::none_of(best.begin(), best.end(), [&](const View& b) { return group(b.abscissa) == group(v.abscissa); }))
      best.push_back(v);
  }
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
  const bool torque = motor || residual == ResidualKind::joint_torque;
  return s.of(torque ? ResidualKind::joint_position : ResidualKind::motor_torque);
}

std::vector<BinMeans> bin_means(const ResidualSignals& s, const View& view) {
  const std::vector<double>& y = s.of(view.residual);
  const std::vector<double>& x = abscissa_of(s, view.residual, view.abscissa);
  if (view.abscissa == Abscissa::constant || y.empty() || x.empty()) return {};
  const Cells cells = cells_of(s, view, y, independent_samples(y, moments(y)));
  const auto [mean, n] = cell_means(y, cells);
  std::vector<double> centre(cells.count, 0);
  for (std::size_t i = 0; i < y.size(); ++i)
    if (cells.of[i] >= 0) centre[cells.of[i]] += within_turn(view.abscissa, x[i]) / n[cells.of[i]];
  std::vector<BinMeans> curves(view.loop ? 2 : 1);
  const int per_curve = cells.count / static_cast<int>(curves.size());
  if (view.loop) curves[0].direction = -1, curves[1].direction = 1;
  for (int b = 0; b < cells.count; ++b)
    if (n[b] > 0) {
      curves[b / per_curve].x.push_back(centre[b]);
      curves[b / per_curve].mean.push_back(mean[b]);
    }
  return curves;
}

std::vector<View> all_views(const ResidualSignals& before, const ResidualSignals& after) {
  std::vector<View> views;
  for (const ResidualKind kind : kResidualKinds) {
    if (before.of(kind).empty() || after.of(kind).empty()) continue;
    // The same abscissa for both, but for the other residual, which is another one.
    ResidualSignals shared = after;
    shared.residual = before.residual;
    const Moments m_before = moments(before.of(kind)), m_after = moments(after.of(kind));
    if (!(m_before.square > 0)) continue;
    const double n_before = independent_samples(before.of(kind), m_before);
    const double n_after = independent_samples(after.of(kind), m_after);
    const auto look = [&](Abscissa abscissa, bool loop) {
      View v{.residual = kind, .abscissa = abscissa, .loop = loop};
      const Explained b = explained(shared, v, m_before, n_before), a = explained(after, v, m_after, n_after);
      v.explained_before = b.share, v.explained_after = a.share;
      v.chance = b.chance, v.swing = b.swing;
      v.left = m_after.square / m_before.square;
      if (is_angle(abscissa)) v.line = strongest_line(angle_spectrum(before, kind, abscissa));
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
  return best_views(all_views(before, after), [](const View& v) { return v.removed(); });
}

std::vector<View> telling_views(const ResidualSignals& rest) {
  std::vector<View> views = all_views(rest, rest);
  std::erase_if(views, [](const View& v) {
    return v.residual == ResidualKind::transmission || v.residual == ResidualKind::joint_torque;
  });
  return best_views(std::move(views), [](const View& v) { return v.explained_before; });
}

Spectrum angle_spectrum(const ResidualSignals& s, ResidualKind residual, Abscissa angle) {
  const std::vector<double>&x = abscissa_of(s, residual, angle), &y = s.of(residual);
  const double turns = range_of(x) / kTurn;
  if (y.empty() || turns < 2) return {};
  // A line whose frequency in time is beyond the residual's band at the usual rate cannot be seen.
  std::vector<double> rate;
  for (std::size_t i = 1; i < x.size(); ++i) rate.push_back(std::abs(x[i] - x[i - 1]) / s.dt);
  std::nth_element(rate.begin(), rate.begin() + static_cast<std::ptrdiff_t>(rate.size() / 2), rate.end());
  const double usual = rate[rate.size() / 2] / kTurn;
  const double highest = usual > 0 ? std::min(kHighestOrder, kBand / usual) : kHighestOrder;
  std::vector<double> in_turns = x;
  for (double& v : in_turns) v /= kTurn;
  // Four frequencies to a resolution cell.
  return spectrum(in_turns, y, std::max(0.5, 2 / turns), highest, std::max(0.25 / turns, kHighestOrder / 4000));
}

}  // namespace halyard
