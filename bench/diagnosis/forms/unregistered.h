#pragma once
/// Effects that serve as truth and never as candidate: they are not in the library.

#include <memory>
#include <string>
#include <vector>

#include "diagnosis/search_space.h"

namespace halyard::blind {

/// The same physics as an effect of the library in another functional form of the literature.
struct OtherForm {
  const Effect* effect;
  std::string like;    ///< the library's name for it, which is the right answer
  std::string beside;  ///< the library's name for a part of it, which is right beside `like`; empty if there is none
};

/// Those whose name the library has.
std::vector<OtherForm> other_forms();

/// Effects for which the library has no name: the right answer is that something unknown is left.
std::vector<const Effect*> outside_effects();

/// An effect whose motion lies above the band of frequencies that a diagnosis compares, so that no plan tells its size.
class AboveBand {
 public:
  virtual ~AboveBand() = default;
  /// Amplitude of the motor's motion in counts of its encoder.
  virtual double encoder_counts(const ArmParameters<double>& arm, int joint, const double* p) const = 0;
};

/// An effect that a plan's prediction cannot integrate, because its steps are longer than the effect lasts.
class PlannedAs {
 public:
  virtual ~PlannedAs() = default;
  /// An effect of the library that changes a log by as much.
  virtual PlacedEffect planned_as(const PlacedEffect& effect, const ArmParameters<double>& arm) const = 0;
};

struct OwnedForm {
  std::unique_ptr<const Effect> effect;
  std::string like, beside = {};
};
using OwnedEffects = std::vector<OwnedForm>;
void add_friction_forms(OwnedEffects& to);
void add_cable_forms(OwnedEffects& to);
void add_motor_forms(OwnedEffects& to);

inline bool has_cable(const ArmParameters<double>& arm, int joint) { return arm.joint[joint].drive == Drive::cable; }
inline bool has_motor(const ArmParameters<double>& arm, int joint) { return arm.joint[joint].drive != Drive::none; }

}  // namespace halyard::blind
