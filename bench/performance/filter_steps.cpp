#include "bench/performance/filter_steps.h"

#include <limits>
#include <memory>

#include "bench/bench_arm.h"
#include "estimators/filters/arm_filter.h"
#include "estimators/filters/ekf.h"
#include "estimators/filters/sr_ukf.h"
#include "estimators/process/arm_models.h"

namespace halyard {
namespace {

/// The process model's step, sigma points one by one in scalar code.
class ScalarProcess final : public ArmProcess {
 public:
  using ArmProcess::ArmProcess;
  void advance(Eigen::MatrixXd& X) const override {
    for (Eigen::Index c = 0; c < X.cols(); ++c) model_.advance(step_, X.col(c).data());
  }
};

}  // namespace

std::vector<StepTime> time_filters(int rounds) {
  const ArmModel model = raven2();
  const std::vector<Sample> samples = recorded(model);
  const auto process = std::make_shared<const ProcessModel>(model);
  const EstimatorOptions none;
  OptionReader reader("performance", none);
  const ArmFilterOptions options = read_arm_filter_options(reader, model, *process);
  const UkfWeights weights{.curvature_limit = 0.03};  // as the plug-in has it

  std::vector<Variant> variants;
  const auto add_filter = [&](const char* name, bool exponential, std::unique_ptr<GaussianFilter> gaussian) {
    ArmFilterOptions own = options;
    own.exponential = exponential;
    const auto filter = std::make_shared<ArmFilter>(model, process, own, std::move(gaussian));
    variants.push_back({name, [&samples, filter](std::size_t i) {
                          if (i == 0) filter->reset(samples[0]);
                          else filter->update(samples[i]);
                        }});
  };
  add_filter("ekf", true, std::make_unique<ExtendedKalmanFilter>());
  add_filter("ekf, sub-steps", false, std::make_unique<ExtendedKalmanFilter>());
  add_filter("sr_ukf", true, std::make_unique<SquareRootUkf>(weights));
  add_filter("sr_ukf, sub-steps", false, std::make_unique<SquareRootUkf>(weights));

  ArmNoise noise(model, *process, options.noise);
  const Eigen::VectorXd start = process->state_at_rest(samples[0].motor_position, model.home());
  const Eigen::MatrixXd S = noise.initial_root(start, std::numeric_limits<double>::infinity());
  const Eigen::MatrixXd R_root = noise.encoder().asDiagonal();
  const Eigen::MatrixXd Q_root = noise.process_root({0, 1e-3}, start);
  const std::vector<int> motors = {0, 1, 2};
  const auto add_bare = [&](const char* name, bool scalar) {
    const auto filter = std::make_shared<SquareRootUkf>(weights);
    variants.push_back({name, [&, filter, scalar](std::size_t i) {
                          if (i == 0) return filter->reset(start, S);
                          const Step step{samples[i - 1].time_s, 1e-3, samples[i - 1].motor_torque.data()};
                          if (scalar) filter->predict(ScalarProcess(*process, step), Q_root);
                          else filter->predict(ArmProcess(*process, step), Q_root);
                          filter->update(MotorReadings(*process, 0, motors), samples[i].motor_position, R_root,
                                         std::numeric_limits<double>::infinity());
                        }});
  };
  add_bare("sr_ukf without noise, sub-steps in lanes", false);
  add_bare("sr_ukf without noise, sub-steps in scalar code", true);

  return time_in_turns(variants, samples.size(), rounds);
}

}  // namespace halyard
