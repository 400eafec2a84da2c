#include <exception>

#include "plant/integrators/integrator.h"
#include "plant/simbody_arm.h"

namespace halyard {
namespace {

class SimbodyIntegrator : public Integrator {
 public:
  SimbodyIntegrator(ArmPlant& plant, const IntegratorOptions& options, double time_s, const Eigen::VectorXd& y)
      : plant_(plant), y_(y) {
    auto& arm = dynamic_cast<SimbodyArm&>(plant.chain());
    if (options.kind == IntegratorKind::simbody_cpodes)
      integrator_ = std::make_unique<SimTK::CPodesIntegrator>(arm.system, SimTK::CPodes::BDF, SimTK::CPodes::Newton);
    else integrator_ = std::make_unique<SimTK::RungeKuttaMersonIntegrator>(arm.system);
    integrator_->setAccuracy(options.relative_tolerance);
    SimTK::State start = arm.state;
    start.setTime(time_s);
    start.updY() = SimTK::Vector(static_cast<int>(y.size()), y.data());
    integrator_->initialize(start);
  }

  void advance(double until_s) override {
    const int before = integrator_->getNumRealizations();
    const double from = integrator_->getTime();
    try {
      // The inputs have changed outside the State.
      integrator_->updAdvancedState().invalidateAllCacheAtOrAbove(SimTK::Stage::Dynamics);
      integrator_->reinitialize(SimTK::Stage::Dynamics, false);
      // The first return is at the start of the interval.
      while (integrator_->getAdvancedTime() < until_s) integrator_->stepTo(until_s, until_s);
    } catch (const std::exception& error) {
      fail_between(from, until_s, error.what());
    }
    plant_.count_evaluations(integrator_->getNumRealizations() - before);
    const SimTK::Vector& y = integrator_->getAdvancedState().getY();
    y_ = Eigen::Map<const Eigen::VectorXd>(&y[0], y.size());
  }

  const Eigen::VectorXd& state() const override { return y_; }

 private:
  ArmPlant& plant_;
  std::unique_ptr<SimTK::Integrator> integrator_;
  Eigen::VectorXd y_;
};

}  // namespace

std::unique_ptr<Integrator> make_simbody_integrator(ArmPlant& plant, const IntegratorOptions& options, double time_s,
                                                    const Eigen::VectorXd& y) {
  return std::make_unique<SimbodyIntegrator>(plant, options, time_s, y);
}

}  // namespace halyard
