#include "evaluation/sweep/sweep_summary.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "model/statistics/distributions.h"

namespace halyard {
namespace {

constexpr std::size_t kMostOfSamples = 40, kBins = 20;

}  // namespace

void MeanWithInterval::add(double x) {
  if (std::isnan(x)) return;
  ++n_;
  const double before = x - mean_;
  mean_ += before / double(n_);
  squares_ += before * (x - mean_);
  least_ = std::min(least_, x);
  greatest_ = std::max(greatest_, x);
}

double MeanWithInterval::mean() const { return n_ > 0 ? mean_ : std::numeric_limits<double>::quiet_NaN(); }

double MeanWithInterval::half_width() const {
  if (n_ < 2) return std::numeric_limits<double>::quiet_NaN();
  const double freedom = double(n_ - 1);
  return t_quantile(freedom, 0.025) * std::sqrt(squares_ / freedom / double(n_));
}

SweepSummary::SweepSummary(const SweepGrid& grid)
    : spans(grid.measures.size(), std::vector(grid.n_subjects(), std::vector<Span>(grid.units.size()))), grid_(grid) {
  for (const SweepAxis& axis : grid.axes)
    places_.push_back(places_of(axis, grid.is_sampled ? kMostOfSamples : kMostPlaces));
  repeats_.resize(grid.measures.size() * grid.n_subjects() * grid.units.size());
  for (std::size_t m = 0; m < grid.measures.size(); ++m)
    for (const Places& places : places_) {
      const std::vector<double>& x = places.centres;
      const Curve curve{x, std::vector<MeanWithInterval>(x.size())};
      curves_.insert(curves_.end(), grid.n_subjects() * grid.units.size(), curve);
    }
}

SweepSummary::Places SweepSummary::places_of(const SweepAxis& axis, std::size_t most) {
  Places places;
  const std::set<double> distinct(axis.values.begin(), axis.values.end());
  if (distinct.size() <= most) {
    places.centres.assign(distinct.begin(), distinct.end());
    places.edges = places.centres;
    return places;
  }
  const bool in_decades = axis.is_logarithmic && *distinct.begin() > 0;
  const auto at = [&](double share) {
    const double from = *distinct.begin(), to = *distinct.rbegin();
    return in_decades ? from * std::pow(to / from, share) : from + share * (to - from);
  };
  for (std::size_t i = 0; i < kBins; ++i) {
    places.centres.push_back(at((double(i) + 0.5) / kBins));
    places.edges.push_back(at(double(i + 1) / kBins));
  }
  places.edges.back() = *distinct.rbegin();
  return places;
}

void SweepSummary::add(const SweepCell& cell) {
  failures += cell.failures();
  const std::vector<double> values = grid_.values(cell.point);
  const std::size_t repeats = grid_.is_sampled ? grid_.n_seeds() : 1;
  auto repeated = repeats_.begin();
  for (std::size_t m = 0; m < grid_.measures.size(); ++m)
    for (std::size_t i = 0; i < grid_.n_subjects(); ++i)
      for (std::size_t k = 0; k < grid_.units.size(); ++k, ++repeated) {
        const double shown = cell.shown(grid_, m, i, k);
        if (!std::isnan(shown)) {
          spans[m][i][k].least = std::min(spans[m][i][k].least, shown);
          spans[m][i][k].greatest = std::max(spans[m][i][k].greatest, shown);
        }
        repeated->add(shown);
        if ((cell.point + 1) % repeats != 0) continue;
        for (std::size_t a = 0; a < grid_.axes.size(); ++a) mean_at(m, a, i, k, values[a]).add(repeated->mean());
        *repeated = {};
      }
}

MeanWithInterval& SweepSummary::mean_at(std::size_t measure, std::size_t axis, std::size_t subject, std::size_t joint,
                                        double value) {
  const std::vector<double>& edges = places_[axis].edges;
  const auto place = std::size_t(std::ranges::lower_bound(edges, value) - edges.begin());
  return curves_[index(measure, axis, subject, joint)].means[std::min(place, edges.size() - 1)];
}

std::size_t SweepSummary::index(std::size_t measure, std::size_t axis, std::size_t subject, std::size_t joint) const {
  return ((measure * grid_.axes.size() + axis) * grid_.n_subjects() + subject) * grid_.units.size() + joint;
}

const SweepSummary::Curve& SweepSummary::curve(std::size_t measure, std::size_t axis, std::size_t subject,
                                               std::size_t joint) const {
  return curves_.at(index(measure, axis, subject, joint));
}

}  // namespace halyard
