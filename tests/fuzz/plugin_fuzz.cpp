// Tables of estimators: a module whose table, answers and numbers come from the input runs over a short log. A failure
// that is not the user's is a std::runtime_error here.
#include <dlfcn.h>

#include "evaluation/run/estimate.h"
#include "model/model_file.h"
#include "plugins/host/plugin_estimator.h"
#include "tests/fuzz/reader.h"

using namespace halyard;
using namespace halyard::fuzzing;

namespace {

Log still_log(int joints, std::size_t samples) {
  Log log(joints);
  for (std::size_t i = 0; i < samples; ++i) log.time.push_back(0.001 * double(i));
  for (Signals* signals : {&log.motor_torque, &log.motor_position})
    for (auto& column : *signals) column.assign(samples, 0.0);
  return log;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const ArmModel model = read_model(HALYARD_FUZZ_FOLDER "/beside/arm.xml");
  static const Log log = still_log(model.n(), 5);
  using TakeInput = void (*)(const std::uint8_t*, std::size_t);
  static const auto take_input =
      reinterpret_cast<TakeInput>(dlsym(dlopen(HALYARD_FUZZ_PLUGIN, RTLD_NOW), "take_input"));
  take_input(data, size);
  reads([&] {
    try {
      PluginEstimator estimator(std::make_shared<const EstimatorModule>(HALYARD_FUZZ_PLUGIN), model);
      run_estimator(estimator, "fuzzed", log);
    } catch (const InputError&) {
      throw;
    } catch (const std::runtime_error& error) {
      check_message(error.what());
    }
  });
  return 0;
}
