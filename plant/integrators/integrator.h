#pragma once
/// Integrates a plant from one control tick to the next. Inputs are constant between ticks and jump at ticks, so no
/// step may cross a tick.

#include <Eigen/Core>
#include <memory>
#include <string>

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

/// For the kind rosenbrock.
std::unique_ptr<Integrator> make_rosenbrock_integrator(ArmPlant& plant, const IntegratorOptions& options, double time_s,
                                                       const Eigen::VectorXd& y);
/// For the kinds simbody_rkm and simbody_cpodes, which need Engine::simbody.
std::unique_ptr<Integrator> make_simbody_integrator(ArmPlant& plant, const IntegratorOptions& options, double time_s,
                                                    const Eigen::VectorXd& y);
/// For the other kinds.
std::unique_ptr<Integrator> make_sundials_integrator(ArmPlant& plant, const IntegratorOptions& options, double time_s,
                                                     const Eigen::VectorXd& y);

/// A state with a tolerance of this size or more is not controlled.
inline constexpr double kUncontrolled = 1e30;
/// The absolute tolerance of each state, [size], from that of joint positions: motor angles get it times gear_ratio,
/// rates 1000 times as much as their positions, and the energy meters kUncontrolled.
Eigen::VectorXd absolute_tolerances(const DriveTrain& drive, double tolerance);

/// Throws the std::runtime_error of an integration that failed, one line.
[[noreturn]] void fail_between(double from_s, double until_s, std::string why);

}  // namespace halyard
