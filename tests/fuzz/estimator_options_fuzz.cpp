// Options of the built-in estimators: the first line of the input names the estimator, each further line is an option
// and its value with '=' between them.
#include "estimators/built_in.h"
#include "model/model_file.h"
#include "tests/fuzz/reader.h"

using namespace halyard;
using namespace halyard::fuzzing;

namespace {

std::unique_ptr<Estimator> make(std::string_view name, const ArmModel& model, const EstimatorOptions& options) {
  if (name == "sr_ukf") return make_sr_ukf(model, options);
  if (name == "ekf") return make_ekf(model, options);
  if (name == "smoother") return make_smoother(model, options);
  if (name == "camera_sr_ukf") return make_camera_sr_ukf(model, options);
  if (name == "disturbance_sr_ukf") return make_disturbance_sr_ukf(model, options);
  return make_kinematics(model, options);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const ArmModel model = read_model(HALYARD_FUZZ_FOLDER "/beside/arm.xml");
  std::string_view text = text_of(data, size);
  const std::string_view name = take_line(text);
  EstimatorOptions options;
  while (!text.empty()) {
    const std::string_view line = take_line(text);
    const std::size_t equals = std::min(line.find('='), line.size());
    options.emplace(line.substr(0, equals), line.substr(std::min(equals + 1, line.size())));
  }
  reads([&] { make(name, model, options); });
  return 0;
}
