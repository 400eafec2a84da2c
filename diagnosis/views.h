#pragma once
/// Residuals that point: over which abscissa does a residual fall onto a curve?
///
///   R² = 1 - Σ (y - ŷ(x))² / Σ (y - ȳ)²                    ŷ piecewise linear on B knots (curve_fit.h)
///   explained = 1 - (1 - R²) (N - 1) / (N - B)             of the variance, less what chance gives with B numbers
///   N = n / (2 Σ_l ρ_y(l) ρ_x(l))                          independent samples, lags l up to the first zero
///
///   y, x   residual, abscissa    ρ_y, ρ_x   their autocorrelations, ρ(0) counts half    n   samples
///
/// A constant has its own share, of the mean square. A loop has a curve for each direction of motion.
/// Sources: Ezekiel, Methods of Correlation Analysis (1930), of R² less chance; Bartlett, J. R. Stat. Soc. 98 (1935),
/// of N.

#include "diagnosis/curve_fit.h"
#include "diagnosis/residual_signals.h"
#include "diagnosis/spectrum.h"

namespace halyard {

/// What a residual is drawn over. Rate and direction are the motor's for a motor torque, the joint's otherwise;
/// other_residual is the position's for a motor torque, the motor torque's otherwise.
enum class Abscissa {
  constant,
  direction,
  joint_position,
  rate,
  load,
  stretch,
  motor_angle,
  capstan_angle,
  time,
  other_residual
};

/// A residual before and after something was added to the model.
struct View {
  ResidualKind residual = ResidualKind::joint_position;
  Abscissa abscissa = Abscissa::constant;
  bool loop = false;
  /// Share of the variance before that goes with the abscissa; of a constant: of the mean square.
  double explained_before = 0;
  double explained_after = 0;  ///< the same after
  double variance_left = 0;    ///< variance after over before; a constant: mean square
  double left = 0;             ///< mean square after over before
  double chance = 0;           ///< an explained_before below is what noise may give
  double swing = 0;            ///< of the curve before, end to end; the constant
  Line line = {};              ///< angles: strongest line before, order a turn
  double removed() const { return explained_before - variance_left * explained_after; }
};

/// The residual as a function of the abscissa, for drawing; of a loop one curve a direction, of a constant none.
std::vector<Curve> view_curves(const ResidualSignals& signals, const View& view);

/// The abscissa of a view, [samples]; empty if these signals do not have it. A constant has time.
const std::vector<double>& abscissa_of(const ResidualSignals& signals, ResidualKind residual, Abscissa abscissa);
/// The angle of an abscissa within its turn, rad; any other abscissa as it is.
double within_turn(Abscissa abscissa, double x);

/// Every view that the signals allow, before and after; the abscissae are those of `after`.
std::vector<View> all_views(const ResidualSignals& before, const ResidualSignals& after);

/// The two or three views that carry the evidence for what was added between before and after: much of the residual
/// goes with the abscissa before and no longer after. Each is over another abscissa; a constant first, if it is most of
/// the residual, then the best first. Empty if there is none.
std::vector<View> telling_views(const ResidualSignals& before, const ResidualSignals& after);

/// The same for a rest: the views of joint position and motor torque that explain most of it.
std::vector<View> telling_views(const ResidualSignals& rest);

/// Spectrum over an angle, lines in orders a turn; empty unless the motion goes through two turns.
Spectrum angle_spectrum(const ResidualSignals& signals, ResidualKind residual, Abscissa angle);

}  // namespace halyard
