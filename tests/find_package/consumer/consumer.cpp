// consumer PLUGIN.so MODEL.xml: runs a plug-in from a program that is no part of halyard.
#include <cmath>
#include <cstdio>
#include <exception>

#include "model/model_file.h"
#include "plugins/host/conformance.h"
#include "plugins/host/loader.h"
#include "transmission/coupling.h"

namespace {

/// Joint 1 moves at 0.1 rad/s for a second; what the estimator says of it in the end.
double velocity_after_a_second(halyard::Estimator& estimator, const halyard::ArmModel& model) {
  for (int i = 0; i <= 1000; ++i) {
    halyard::Sample sample;
    sample.time_s = 1e-3 * i;
    sample.motor_torque = Eigen::VectorXd::Zero(model.n());
    Eigen::VectorXd q = model.home();
    q(0) += 0.1 * sample.time_s;
    sample.motor_position = halyard::unstretched_motors(model.nominal, q);
    if (i == 0) estimator.reset(sample);
    else estimator.update(sample);
  }
  return estimator.estimate().joint_velocity(0);
}

int run(const char* plugin, const char* model_file) {
  const halyard::ArmModel model = halyard::read_model(model_file);
  const auto faults = halyard::conformance_faults(plugin, model);
  for (const std::string& fault : faults) std::printf("fault: %s\n", fault.c_str());
  if (!faults.empty()) return 1;

  // Built-in ones are found by name from here too.
  const auto built_in = halyard::make_estimator("kinematics", model);
  const auto loaded = halyard::make_estimator(plugin, model);
  std::printf("%s: promises kept, velocity of joint 1 %.4f rad/s of %.4f\n", halyard::find_plugin(plugin).name.c_str(),
              velocity_after_a_second(*loaded, model), velocity_after_a_second(*built_in, model));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    return run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::printf("%s\n", error.what());
    return 1;
  }
}
