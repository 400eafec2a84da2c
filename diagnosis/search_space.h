#pragma once
/// Where a diagnosis looks for the parameters of an effect, and what of them is nothing new: everything about an effect
/// that is not its physics.
///
/// Each effect has a search space that is derived from its bounds and neutral values. Those of the library are refined
/// in search_space/; an effect of your own may refine its own by deriving from RefinesSearch beside EffectOf.

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/tolerances.h"
#include "transmission/effect.h"

namespace halyard {

/// Between which bounds a parameter is sought, and from where.
enum class SearchRange {
  own,             ///< the bounds and starts of the parameter itself
  record_time,     ///< an instant on the log's clock, s: within the record
  joint_position,  ///< a position of the effect's joint: within the motion of the record
};

/// A number of the model that is known within a tolerance, and that a parameter of an effect changes. A change within
/// the tolerance is a refit of that number; an effect has to be beyond it.
struct TolerancedNumber {
  double Tolerances::*kind = nullptr;  ///< null: there is no such number
  int joint = 0;                       ///< 0-based: whose tolerances
  double size = 0;                     ///< |value| of the number, unit of the parameter
};

/// How one parameter of an effect is sought.
struct ParameterSearch {
  std::string name;  ///< as in Effect::parameters()
  /// Values to set out from, where the typical value alone is no good start: orders of a ripple, decades of a time
  /// constant. Ascending: a fit takes steps after their spacing. Empty: the value at hand.
  std::vector<double> starts = {};
  SearchRange range = SearchRange::own;
  /// True if a bound is a limit of nature that may well be reached (a friction of zero, a share of one). False if it is
  /// the end of what is plausible, where a fit explains nothing.
  bool natural_bounds = false;
  TolerancedNumber changes = {};  ///< the number of the model that it changes, if any
};

struct SearchSpace {
  std::vector<ParameterSearch> parameters;  ///< as Effect::parameters()
  /// Place of the parameter that says how many periods a turn the torque has that the effect adds at the motor, if that
  /// is periodic in the motor's angle: a record shows less of it the faster the motor turns (filtered_effect.h).
  std::optional<std::size_t> order_of_motor_torque = {};

  /// Throws std::invalid_argument for an unknown name.
  ParameterSearch& operator[](const std::string& name) {
    for (ParameterSearch& p : parameters)
      if (p.name == name) return p;
    throw std::invalid_argument("search space: the effect has no parameter \"" + name + "\"; name one of its own");
  }
};

/// The interface of an effect that says how its parameters are to be sought.
class RefinesSearch {
 public:
  virtual ~RefinesSearch() = default;
  /// Changes the space that was derived from the bounds. Adds and removes no parameter.
  virtual void refine_search(SearchSpace& space, const ArmParameters<double>& arm, int joint) const = 0;
};

/// The search space of an effect at a place of an arm.
/// Throws InputError if the effect's own refinement throws or is wrong: starts that do not ascend or lie outside the
/// bounds, other parameters than the effect's.
SearchSpace search_space(const Effect& effect, const ArmParameters<double>& arm, int joint);

}  // namespace halyard
