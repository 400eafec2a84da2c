#pragma once
/// Search space of an effect: the ranges and start values with which a diagnosis fits its parameters, and the changes
/// that the model's tolerances already explain.
///
/// The search space is derived from the effect's bounds and neutral values. For the library's effects it is refined in
/// search_space/. An effect of your own can refine it by deriving from RefinesSearch in addition to EffectOf.

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/tolerances.h"
#include "transmission/effect.h"

namespace halyard {

inline constexpr double kFewestPeriods = 1.5;    ///< of a periodic effect that the motion must cover
inline constexpr double kNearStandstill = 0.25;  ///< share of the fastest motion below which friction may bend

/// The range in which a parameter is fitted.
enum class SearchRange {
  own,             ///< the bounds and starts of the parameter itself
  record_time,     ///< the parameter is an instant on the log's clock, s: within the record
  joint_position,  ///< the parameter is a position of the effect's joint: within the motion of the record
};

/// A model parameter that has a tolerance and that a parameter of an effect changes. A change within the tolerance
/// counts as a refit of the model parameter; only a larger one is an effect.
struct TolerancedNumber {
  double Tolerances::*kind = nullptr;  ///< null: there is no such model parameter
  int joint = 0;                       ///< 0-based joint that has the tolerance
  double size = 0;                     ///< |value| of the model parameter, unit of the effect's parameter
};

/// How one parameter of an effect is fitted.
struct ParameterSearch {
  std::string name;  ///< as in Effect::parameters()
  /// Start values of the fit, where the typical value alone is a bad start: orders of a ripple, decades of a time
  /// constant. They must ascend: their spacing sets the fit's step sizes. Empty: the current value.
  std::vector<double> starts = {};
  SearchRange range = SearchRange::own;
  /// True if a bound is a physical limit that the true value can reach (zero friction, a share of one). False if it is
  /// the end of the plausible range: a fit that ends there explains nothing.
  bool natural_bounds = false;
  /// True if only whole numbers are plausible, such as the order of a ripple. The fit keeps the value of a start.
  bool is_whole = false;
  /// Of a position: the effect acts beyond it all the way, above it if its size is positive, else below. It is a wall,
  /// and one that is touched in nearly the whole motion is a spring.
  bool is_wall = false;
  /// For a speed near standstill: its unit per rad/s of the motor, else 0. It is at most kNearStandstill of the fastest
  /// motion of the records; what changes over the whole range of speeds is another law.
  double per_motor_speed = 0;
  TolerancedNumber changes = {};  ///< the model parameter that it changes, if any
  /// For an essential parameter: the value at which the effect is another one. Friction that drifts at no rate is only
  /// more friction, and a loop that yields at once is a softer cable. The effect is named only if it explains more than
  /// that other one: SearchSpace::another, or if there is none, itself with this value.
  std::optional<double> another_at = {};
};

/// The effect that an effect of a joint is at an end of its essential shapes, as a loop is a softer cable if it yields
/// at once. Only effects of the library have one.
struct AnotherEffect {
  std::string name;  ///< of the library
  /// Parameters of the effect itself with which it is nearly this other one.
  std::vector<double> (*own_from_other)(const double* other) = nullptr;
  /// Parameters of the other one that is nearly the effect itself. `fitted` are the numbers of the joint beside the
  /// effect; beside the other one they are `nominal`.
  std::vector<double> (*other_from_own)(const double* own, const JointParameters<double>& fitted,
                                        const JointParameters<double>& nominal) = nullptr;
};

/// The motion of a record has to contain at least kFewestPeriods periods of an effect that is periodic in a position:
/// within less, a sine looks like a zero error, a slope and a curvature.
struct SearchSpace {
  std::vector<ParameterSearch> parameters;  ///< in the order of Effect::parameters()
  /// For an effect whose torque is periodic in the motor's angle: index of the parameter that gives the number of
  /// periods per motor turn. The faster the motor turns, the less of that torque a record shows (filtered_effect.h).
  std::optional<std::size_t> order_of_motor_torque = {};
  /// For an effect that is periodic in the joint's position: index of the parameter k of its phase k q. Unless k is a
  /// whole number, its starts become those that the motion can tell apart.
  std::optional<std::size_t> order_of_joint_position = {};
  /// For an effect that limits the speed of the motor: index of the parameter that is this speed, rad/s. A motor hardly
  /// exceeds it, so the search also starts a little above the fastest motion of the records.
  std::optional<std::size_t> greatest_motor_speed = {};
  /// For an effect that is periodic in the motor's angle with a period of its own: that period, rad.
  std::optional<double> period_of_motor = {};
  /// The effect is named only if it explains more than this one. If this one is named, the effect is an alternative.
  std::optional<AnotherEffect> another = {};
  /// True if the model's numbers that the effect changes are fitted beside it: it changes them in one proportion, and
  /// so cannot take their places.
  bool numbers_stay = false;

  /// Throws std::invalid_argument for an unknown name.
  ParameterSearch& operator[](const std::string& name) {
    for (ParameterSearch& p : parameters)
      if (p.name == name) return p;
    throw std::invalid_argument("search space: the effect has no parameter \"" + name + "\"; name one of its own");
  }
};

/// Interface of an effect that refines its own search space.
class RefinesSearch {
 public:
  virtual ~RefinesSearch() = default;
  /// Changes the space that was derived from the bounds. Must not add or remove parameters.
  virtual void refine_search(SearchSpace& space, const ArmParameters<double>& arm, EffectPlace joint) const = 0;
};

/// The search space of an effect at this place.
/// Throws InputError if the effect's own refinement throws or is invalid: starts that do not ascend or lie outside the
/// bounds, or parameters that the effect does not have.
SearchSpace search_space(const Effect& effect, const ArmParameters<double>& arm, EffectPlace joint);

/// Indices of the parameters of an effect that are instants of a log, as of a push or a slip.
std::vector<std::size_t> instants_of(const PlacedEffect& effect, const ArmParameters<double>& arm);

/// True for an effect that has such parameters.
bool has_instants(const PlacedEffect& effect, const ArmParameters<double>& arm);

/// True for an effect that happens at an instant, and so belongs to a log and not to the arm: a size to which an
/// instant belongs is not neutral. A force that is only a contact has instants and is no event.
bool is_event(const PlacedEffect& effect, const ArmParameters<double>& arm);

}  // namespace halyard
