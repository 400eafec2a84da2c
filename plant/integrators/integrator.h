#pragma once
/// Integrates a plant from one control tick to the next. Inputs are constant between ticks and jump at ticks, so no
/// step may cross a tick.

#include <Eigen/Core>
#include <memory>

#include "plant/arm_plant.h"
#include "plant/scenario.h"

namespace halyard {

class Integrator {
 public:
  virtual ~Integrator() = default;
  /// Integrates to this time with the plant's current inputs. Throws std::runtime_error with the time if it fails.
  virtual void advance(double until_s) = 0;
  /// y at the time reached.
  virtual const Eigen::VectorXd& state() const = 0;
};

/// The plant must outlive the integrator. Error control ignores the energy meters: only the other states determine the
/// step size.
std::unique_ptr<Integrator> make_integrator(ArmPlant& plant, const IntegratorOptions& options, double time_s,
                                            const Eigen::VectorXd& y);

/// For the kinds simbody_rkm and simbody_cpodes.
std::unique_ptr<Integrator> make_simbody_integrator(ArmPlant& plant, const IntegratorOptions& options, double time_s,
                                                    const Eigen::VectorXd& y);

}  // namespace halyard
