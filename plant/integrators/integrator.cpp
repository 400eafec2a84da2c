#include "plant/integrators/integrator.h"

#include <algorithm>
#include <stdexcept>

#include "model/output/number_text.h"

namespace halyard {
namespace {

/// Absolute tolerance of rates over that of positions: a rate may be off by what moves a position by its own tolerance
/// within a millisecond. A tolerance of rates as small as that of positions buys no accuracy of the motion (measured
/// on RAVEN-II, dirk, sines of 2 s: largest error 6e-9 rad either way) and costs twice the time where the arm stands
/// still.
constexpr double kRateTolerance = 1e3;

/// An effect at the command stage may look back at past commands, whose slope has corners. The error estimate of
/// rosenbrock misses corners: with a delay it is off by 7e-6 rad, dirk by 1e-7 (RAVEN-II, sines).
bool may_look_back(const PlacedEffect& e) { return e.effect->stages() & static_cast<unsigned>(EffectStage::command); }

IntegratorKind kind_for(const ArmPlant& plant) {
  return std::ranges::any_of(plant.drive().transmission().effects(), may_look_back) ? IntegratorKind::dirk
                                                                                    : IntegratorKind::rosenbrock;
}

}  // namespace

Eigen::VectorXd absolute_tolerances(const DriveTrain& drive, double tolerance) {
  const PlantLayout& l = drive.layout();
  Eigen::VectorXd all = Eigen::VectorXd::Constant(l.size(), tolerance);
  all.segment(l.n, l.n) *= kRateTolerance;
  Eigen::Ref<Eigen::VectorXd> z = all.tail(l.n_z);
  for (int k = 0; k < l.n; ++k) {
    if (!l.motor_angle[k]) continue;
    const double turns = drive.arm().joint[k].gear_ratio;
    z(*l.motor_angle[k]) *= turns;
    z(*l.motor_rate[k]) *= turns * kRateTolerance;
  }
  z(l.input_energy) = z(l.lost_energy) = kUncontrolled;
  return all;
}

void fail_between(double from_s, double until_s, std::string why) {
  std::replace(why.begin(), why.end(), '\n', ' ');  // Simbody's messages have several lines
  throw std::runtime_error("integration failed between t = " + with_decimals(from_s, 6) + " s and " +
                           with_decimals(until_s, 6) + " s: " + why +
                           "; check stiffness, damping, friction and the controllers' gains, or set other tolerances");
}

std::unique_ptr<Integrator> make_integrator(ArmPlant& plant, const IntegratorOptions& options, double time_s,
                                            const Eigen::VectorXd& y) {
  switch (options.kind) {
    case IntegratorKind::automatic:
      return make_integrator(plant, {kind_for(plant), options.relative_tolerance, options.absolute_tolerance}, time_s,
                             y);
    case IntegratorKind::rosenbrock: return make_rosenbrock_integrator(plant, options, time_s, y);
    case IntegratorKind::simbody_rkm:
    case IntegratorKind::simbody_cpodes: return make_simbody_integrator(plant, options, time_s, y);
    case IntegratorKind::dirk:
    case IntegratorKind::imex:
    case IntegratorKind::imex_link1:
    case IntegratorKind::bdf:
    case IntegratorKind::explicit_rk: break;
  }
  return make_sundials_integrator(plant, options, time_s, y);
}

}  // namespace halyard
