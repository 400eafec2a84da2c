#pragma once
/// Views in words: names, units, and a sentence about the evidence.

#include <string>

#include "diagnosis/explanation/views.h"

namespace halyard {

/// Unit of a displayed number: 0.35 deg.
struct ShownUnit {
  std::string name;
  double per_si = 1;
};

/// If a motor's angle equals the position of a prismatic joint, 1 m per rad, its torque is shown as a force in N.
ShownUnit residual_unit(const ArmParameters<double>& arm, int joint, ResidualKind residual);
ShownUnit abscissa_unit(const ArmParameters<double>& arm, int joint, ResidualKind residual, Abscissa abscissa);

/// "position residual", "motor torque residual" | "motor force residual", ...
std::string residual_name(const ArmParameters<double>& arm, int joint, ResidualKind residual);
/// "load", "motor rate", ...
std::string abscissa_name(ResidualKind residual, Abscissa abscissa);

/// A value in SI: "0.35 deg"
std::string shown(double value, const ShownUnit& unit);
/// "81 %", "0.4 %", "less than 0.1 %", "over 99 %"
std::string shown_share(double share);

/// What the residual does before the addition to the model: "steps by ±0.35 deg at each reversal: 81 % of its variance
/// goes with the direction of motion".
std::string view_phrase(const View& view, const ArmParameters<double>& arm, int joint);

}  // namespace halyard
