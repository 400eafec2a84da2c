#pragma once
/// Residuals that point: over which abscissa does a residual fall onto a curve?
///
///   η² = Σ_b n_b (ȳ_b - ȳ)² / Σ_i (y_i - ȳ)²                 correlation ratio over bins b of the abscissa
///   explained = (1 - (1 - η²) (N - 1) / (N - B)) var(y) / mean(y²)
///
///   y   residual                             ȳ_b, n_b   mean and samples of bin b, B bins
///   N   independent samples: those there are, over the residual's correlation time
///
/// The second line takes off what chance gives with so many bins, and counts against the mean square, so that a constant
/// has its own share. A loop is a view whose bins are of the abscissa and of the direction of motion.
/// Source: Fisher, Statistical Methods for Research Workers, § 45; Kelley, Proc. Natl. Acad. Sci. 21 (1935).

#include "diagnosis/residual_signals.h"
#include "diagnosis/spectrum.h"

namespace halyard {

/// What a residual is drawn over. Rate and direction are the motor's for a motor torque, the joint's otherwise;
/// other_residual is the motor torque's for a position, and the position's for a torque.
enum class Abscissa {
  constant, direction, joint_position, rate, load, stretch, motor_angle, capstan_angle, time, other_residual
};

/// A residual before and after something was added to the model.
struct View {
  ResidualKind residual = ResidualKind::joint_position;
  Abscissa abscissa = Abscissa::constant;
  bool loop = false;
  double explained_before = 0;   ///< share of the mean square before that goes with the abscissa
  double explained_after = 0;    ///< share of the mean square after that goes with it
  double left = 0;               ///< mean square after over before
  double chance = 0;             ///< an explained_before below is what noise may give
  double swing = 0;              ///< of the bins' means before; after, where there is nothing before
  Line line = {};                ///< angles: strongest line before, order a turn
  double removed() const { return explained_before - left * explained_after; }
};

/// Mean of a residual in each bin of the abscissa, for drawing; `direction` 1 | -1 for one side of a loop, 0 otherwise.
struct BinMeans {
  double direction = 0;
  std::vector<double> x, mean;
};
std::vector<BinMeans> bin_means(const ResidualSignals& signals, const View& view);

/// The abscissa of a view, [samples]; empty if these signals do not have it. A constant has time.
const std::vector<double>& abscissa_of(const ResidualSignals& signals, ResidualKind residual, Abscissa abscissa);
/// The angle of an abscissa within its turn, rad; any other abscissa as it is.
double within_turn(Abscissa abscissa, double x);

/// Every view that the signals allow, before and after; the abscissae are those of `after`.
std::vector<View> all_views(const ResidualSignals& before, const ResidualSignals& after);

/// The two or three views that carry the evidence for what was added between before and after: most of the residual goes
/// with the abscissa before and no longer after. Best first, each over another abscissa. Empty if there is none.
std::vector<View> telling_views(const ResidualSignals& before, const ResidualSignals& after);

/// The same for a rest: the views of joint position and motor torque that explain most of it.
std::vector<View> telling_views(const ResidualSignals& rest);

/// Spectrum over an angle, lines in orders a turn; empty unless the motion goes through two turns.
Spectrum angle_spectrum(const ResidualSignals& signals, ResidualKind residual, Abscissa angle);

}  // namespace halyard
