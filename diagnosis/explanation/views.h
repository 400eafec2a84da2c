#pragma once
/// Views of a residual: over which abscissa does it lie on a curve?
///
///   R² = 1 - Σ (y - ŷ(x))² / Σ (y - ȳ)²                    ŷ piecewise linear on B knots (curve_fit.h)
///   explained = 1 - (1 - R²) (N - 1) / (N - B)             share of the variance, corrected for B fitted numbers
///   N = n / (2 Σ_l ρ_y(l) ρ_x(l))                          independent samples, lags l up to the first zero
///
///   y, x   residual, abscissa    ρ_y, ρ_x   their autocorrelations, ρ(0) counts half    n   samples
///
/// For a constant, shares are of the mean square. A loop has a curve for each direction of motion.
/// Sources: for R² corrected for chance, Ezekiel, Methods of Correlation Analysis (1930); for N, Bartlett, J. R. Stat.
/// Soc. 98 (1935).

#include "diagnosis/explanation/curve_fit.h"
#include "diagnosis/explanation/residual_signals.h"
#include "diagnosis/explanation/spectrum.h"

namespace halyard {

/// The abscissa of a residual. For a motor torque, rate and direction are the motor's and other_residual is that of the
/// position. Otherwise they are the joint's, and other_residual is that of the motor torque.
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
  /// Before the addition: share of the variance that the curve over the abscissa explains; for a constant, share of the
  /// mean square.
  double explained_before = 0;
  double explained_after = 0;  ///< the same after
  double variance_left = 0;    ///< variance after / variance before; for a constant: of the mean squares
  double left = 0;             ///< mean square after / mean square before
  double chance = 0;           ///< noise alone may give an explained_before up to this
  double swing = 0;            ///< range of the curve before; for a constant its value
  Line line = {};              ///< for angles: strongest spectral line before, order per turn
  double removed() const { return explained_before - variance_left * explained_after; }
};

/// The residual as a function of the abscissa, for charts. A loop has one curve for each direction, a constant none.
std::vector<Curve> view_curves(const ResidualSignals& signals, const View& view);

/// The abscissa of a view, [samples]; empty if these signals do not have it; time for a constant.
const std::vector<double>& abscissa_of(const ResidualSignals& signals, ResidualKind residual, Abscissa abscissa);
/// An angle is reduced to one turn, rad; other abscissae are returned unchanged.
double within_turn(Abscissa abscissa, double x);

/// All views that the signals allow, before and after; the abscissae are those of `after`.
std::vector<View> all_views(const ResidualSignals& before, const ResidualSignals& after);

/// The two or three views with the best evidence for the change between before and after: the abscissa explains much of
/// the residual before, and little after. Their abscissae differ. A constant comes first if it is most of the residual;
/// the others follow, best first. Empty if there is none.
std::vector<View> telling_views(const ResidualSignals& before, const ResidualSignals& after);

/// The same for an unexplained residual: the views of joint position and motor torque that explain most of it.
std::vector<View> telling_views(const ResidualSignals& rest);

/// Spectrum over an angle, frequencies in orders per turn; empty if the motion covers less than two turns.
Spectrum angle_spectrum(const ResidualSignals& signals, ResidualKind residual, Abscissa angle);

}  // namespace halyard
