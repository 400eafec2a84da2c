#include "evaluation/comparison/assumed_noise.h"

#include <cmath>

#include "estimators/process/noise.h"

namespace halyard {

TickNoise assumed_noise(const ArmModel& model, double tick_s, double factor) {
  const ProcessModel process(model);
  const EstimatorOptions none;
  OptionReader options("the noise rule", none);
  const NoiseLevels levels = read_noise(options, model, process);
  const double held = std::sqrt(2 * levels.correlation_time / tick_s);
  TickNoise noise;
  for (int k = 0; k < model.n(); ++k) {
    noise.motor_torque.push_back(held * levels.torque(k) * factor);
    noise.joint_force.push_back(held * levels.joint_force(k) * factor);
    noise.motor_reading.push_back(levels.encoder(k) * factor);
  }
  return noise;
}

}  // namespace halyard
