#include "transmission/effects/library.h"

namespace halyard {
namespace effects {

/// Defined in each effect's own file: see built_in.h.
template <class E>
std::unique_ptr<const Effect> make_effect();

/// In the order of the library.
constexpr std::unique_ptr<const Effect> (*kMakers[])() = {
    make_effect<class Payload>,
    make_effect<class GravityTilt>,
    make_effect<class MotorFriction>,
    make_effect<class JointFriction>,
    make_effect<class MotorPresliding>,
    make_effect<class JointPresliding>,
    make_effect<class Stribeck>,
    make_effect<class PulleyFriction>,
    make_effect<class Hysteresis>,
    make_effect<class Backlash>,
    make_effect<class Slack>,
    make_effect<class Stiffness>,
    make_effect<class CouplingError>,
    make_effect<class Creep>,
    make_effect<class CapstanRatio>,
    make_effect<class CapstanEccentricity>,
    make_effect<class EncoderOffset>,
    make_effect<class EncoderEccentricity>,
    make_effect<class TorqueRipple>,
    make_effect<class TorqueScale>,
    make_effect<class Delay>,
    make_effect<class CableSlip>,
    make_effect<class ExternalForce>,
    make_effect<class FrictionDrift>,
    make_effect<class ActuatorSaturation>,
};

}  // namespace effects

std::vector<std::unique_ptr<const Effect>> built_in_effects() {
  std::vector<std::unique_ptr<const Effect>> all;
  for (const auto make : effects::kMakers) all.push_back(make());
  return all;
}

}  // namespace halyard
