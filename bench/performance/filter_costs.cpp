#include "bench/performance/filter_costs.h"

#include <memory>

#include "estimators/built_in.h"
#include "tests/support/arm_runs.h"

namespace halyard {
namespace {

using Make = std::unique_ptr<Estimator> (*)(const ArmModel&, const EstimatorOptions&);

/// An arm with its record.
struct Recorded {
  ArmModel model;
  std::shared_ptr<const std::vector<Sample>> samples = std::make_shared<std::vector<Sample>>(recorded(model));
};

Variant variant(const std::string& name, Make make, const Recorded& arm) {
  const std::shared_ptr<Estimator> estimator = make(arm.model, {});
  return {name, [samples = arm.samples, estimator](std::size_t i) {
            if (i == 0) return estimator->reset((*samples)[0]);
            estimator->update((*samples)[i]);
            while (estimator->revise(false)) {}
          }};
}

ArmModel with_three_effects() {
  ArmModel model = raven2();
  int joint = 0;
  for (const char* name : {"motor_friction", "torque_ripple", "backlash"}) {
    model.effects.push_back(place_effect(*find_effect(name), model.nominal, joint));
    ++joint;
  }
  return model;
}

}  // namespace

std::vector<StepTime> time_estimators(int rounds) {
  const Recorded plain{raven2()}, effects{with_three_effects()};
  return time_in_turns(
      {variant("kinematics", &make_kinematics, plain), variant("ekf", &make_ekf, plain),
       variant("sr_ukf", &make_sr_ukf, plain), variant("disturbance_sr_ukf", &make_disturbance_sr_ukf, plain),
       variant("smoother", &make_smoother, plain), variant("camera_sr_ukf", &make_camera_sr_ukf, plain),
       variant("ekf, three effects", &make_ekf, effects), variant("sr_ukf, three effects", &make_sr_ukf, effects)},
      plain.samples->size(), rounds);
}

std::vector<StepTime> time_chains(int rounds) {
  std::vector<Variant> variants;
  std::size_t samples = 0;
  for (int n = 1; n <= kMaxJoints; ++n) {
    const Recorded chain{chain_of(n, 1)};
    samples = chain.samples->size();
    variants.push_back(variant("ekf", &make_ekf, chain));
    variants.push_back(variant("sr_ukf", &make_sr_ukf, chain));
  }
  return time_in_turns(variants, samples, rounds);
}

}  // namespace halyard
