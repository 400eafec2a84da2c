#include "app/pages/diagnosis/view_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/explanation/view_sentence.h"

namespace halyard {
namespace {

constexpr std::size_t kPoints = 1200;        ///< of a scatter's series
constexpr std::size_t kPlace[] = {0, 1, 6};  ///< in the palette: without, with, curve

std::string label(const std::string& name, const ShownUnit& unit) {
  return unit.name.empty() ? name : name + " [" + unit.name + "]";
}

bool over_time(const View& v) { return v.abscissa == Abscissa::constant || v.abscissa == Abscissa::time; }

/// A step at reversals is seen over the rate.
Abscissa drawn_abscissa(const View& v) {
  return v.abscissa == Abscissa::constant    ? Abscissa::time
         : v.abscissa == Abscissa::direction ? Abscissa::rate
                                             : v.abscissa;
}

report::Series points(const std::string& name, std::size_t colour, const ResidualSignals& residual,
                      const ResidualSignals& abscissa, const View& v, double x_scale, double y_scale) {
  report::Series s{.name = name, .colour = kPlace[colour]};
  const std::vector<double>&x = abscissa_of(abscissa, v.residual, drawn_abscissa(v)), &y = residual.of(v.residual);
  const std::size_t stride = over_time(v) ? 1 : y.size() / kPoints + 1;
  for (std::size_t i = 0; i < y.size(); i += stride) {
    if (!over_time(v) && !(std::isfinite(x[i]) && std::isfinite(y[i]))) continue;
    s.x.push_back(x_scale * within_turn(v.abscissa, x[i]));
    s.y.push_back(y_scale * y[i]);
  }
  return s;
}

/// The curve that the residual falls onto, as dots so close that they make a line; of a step at reversals one for each
/// direction.
report::Series curve(const ResidualSignals& signals, const View& v, double x_scale, double y_scale) {
  report::Series s{.name = "curve without it", .colour = kPlace[2]};
  constexpr int kDots = 150;
  const auto dots = [&](double x0, double y0, double x1, double y1, int count) {
    for (int i = 0; i < count; ++i) {
      s.x.push_back(x_scale * (x0 + (x1 - x0) * i / count));
      s.y.push_back(y_scale * (y0 + (y1 - y0) * i / count));
    }
  };
  for (const Curve& side : view_curves(signals, v)) {
    if (v.abscissa == Abscissa::direction) {
      double reach = 0;
      for (const double x : abscissa_of(signals, v.residual, Abscissa::rate)) reach = std::max(reach, std::abs(x));
      for (std::size_t b = 0; b < side.x.size(); ++b) dots(0, side.y[b], side.x[b] * reach, side.y[b], kDots);
      continue;
    }
    if (side.x.size() < 2) continue;
    const double whole = side.x.back() - side.x.front();
    for (std::size_t b = 0; b + 1 < side.x.size() && whole > 0; ++b)
      dots(side.x[b], side.y[b], side.x[b + 1], side.y[b + 1],
           std::max(6, static_cast<int>(kDots * (side.x[b + 1] - side.x[b]) / whole)));
  }
  return s;
}

report::Chart spectrum_chart(const EffectEvidence& e, const View& v, const std::string& residual, bool is_rest) {
  const std::string turn = v.abscissa == Abscissa::motor_angle ? "motor" : "capstan";
  report::Chart chart{.title = capitalised(residual) + " by order of the " + turn,
                      .x_label = "order [per turn of the " + turn + "]",
                      .y_label = "share of the variance [%]",
                      .kind = report::ChartKind::line};
  const auto add = [&](const char* name, std::size_t colour, const ResidualSignals& signals) {
    Spectrum s = angle_spectrum(signals, v.residual, v.abscissa);
    for (double& share : s.share) share *= 100;
    chart.series.push_back({.name = name, .x = s.frequency, .y = s.share, .colour = kPlace[colour]});
  };
  add(is_rest ? "residual" : "without it", 0, e.without);
  if (!is_rest) add("with it", 1, e.with);
  return chart;
}

/// Loops over reversal: how far the motors are ahead of the joint, over the load on the cable.
report::Chart loop_chart(const EffectEvidence& e, const ArmParameters<double>& arm) {
  const View v{.residual = ResidualKind::transmission, .abscissa = Abscissa::load};
  const ShownUnit y = residual_unit(arm, e.joint, v.residual);
  report::Chart chart{
      .title = fmt::format("Joint {}: joint behind its motors, over load", e.joint + 1),
      .x_label = label(abscissa_name(v.residual, v.abscissa), abscissa_unit(arm, e.joint, v.residual, v.abscissa)),
      .y_label = label("motors - joint", y),
      .kind = report::ChartKind::scatter};
  chart.series.push_back(points("measured", 2, e.with, e.with, v, 1, y.per_si));
  const auto add_predicted = [&](const char* name, std::size_t colour, const ResidualSignals& signals) {
    ResidualSignals predicted = e.with;
    std::vector<double>& ahead = predicted.residual[static_cast<std::size_t>(v.residual)];
    for (std::size_t i = 0; i < ahead.size(); ++i)
      ahead[i] = signals.of(v.residual)[i] + signals.of(ResidualKind::joint_position)[i];
    chart.series.push_back(points(name, colour, predicted, predicted, v, 1, y.per_si));
  };
  add_predicted("predicted without it", 0, e.without);
  add_predicted("with it", 1, e.with);
  return chart;
}

/// What is drawn if no view says much: over time, the residual that the effect takes most of; nothing if it takes none.
std::vector<View> over_time_only(const EffectEvidence& e) {
  std::vector<View> best;
  double least = 1;
  for (const ResidualKind kind : kResidualKinds) {
    const std::vector<double>&before = e.without.of(kind), &after = e.with.of(kind);
    double sum_before = 0, sum_after = 0;
    for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
      if (!std::isfinite(before[i]) || !std::isfinite(after[i])) continue;
      sum_before += before[i] * before[i];
      sum_after += after[i] * after[i];
    }
    if (sum_after < least * sum_before) {
      least = sum_after / sum_before;
      best = {View{.residual = kind, .abscissa = Abscissa::time}};
    }
  }
  return best;
}

}  // namespace

std::vector<report::Chart> view_charts(const EffectEvidence& e, const ArmParameters<double>& arm, bool is_rest) {
  std::vector<report::Chart> charts;
  for (const View& v : e.views.empty() && !is_rest ? over_time_only(e) : e.views) {
    const Abscissa abscissa = drawn_abscissa(v);
    const ShownUnit x = abscissa_unit(arm, e.joint, v.residual, abscissa), y = residual_unit(arm, e.joint, v.residual);
    const std::string residual = residual_name(arm, e.joint, v.residual), over = abscissa_name(v.residual, abscissa);
    report::Chart chart{.title = fmt::format("Joint {}: {} over {}", e.joint + 1, residual, over),
                        .x_label = label(over, x),
                        .y_label = label("residual", y),
                        .kind = over_time(v) ? report::ChartKind::line : report::ChartKind::scatter};
    // All over the same abscissa, the revised model's, but for another residual.
    ResidualSignals shared = e.with;
    shared.residual = e.without.residual;
    chart.series.push_back(points(is_rest ? "residual" : "without it", 0, e.without, shared, v, x.per_si, y.per_si));
    if (!is_rest) chart.series.push_back(points("with it", 1, e.with, e.with, v, x.per_si, y.per_si));
    if (!over_time(v)) {
      chart.series.push_back(curve(shared, v, x.per_si, y.per_si));
      if (is_rest) chart.series.back().name = "curve";
    }
    charts.push_back(std::move(chart));
    if (v.abscissa == Abscissa::motor_angle || v.abscissa == Abscissa::capstan_angle)
      charts.push_back(spectrum_chart(e, v, residual, is_rest));
  }
  if (!is_rest && charts.size() < 3 && !e.with.of(ResidualKind::transmission).empty())
    charts.push_back(loop_chart(e, arm));
  return charts;
}

}  // namespace halyard
