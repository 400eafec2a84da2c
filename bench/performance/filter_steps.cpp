#include "bench/performance/filter_steps.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>

#include "bench/bench_arm.h"
#include "estimators/filters/arm_filter.h"
#include "estimators/filters/ekf.h"
#include "estimators/filters/sr_ukf.h"
#include "estimators/process/arm_models.h"

namespace halyard {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kBlock = 100;  // steps of a variant before it is the next one's turn

std::vector<Sample> recorded(const ArmModel& model) {
  const Log log = simulate(faster(sines(model, 2))).measured;
  std::vector<Sample> samples(log.size());
  for (std::size_t i = 0; i < log.size(); ++i) {
    samples[i].time_s = log.time[i];
    samples[i].motor_torque.resize(log.n_joints);
    samples[i].motor_position.resize(log.n_joints);
    for (int k = 0; k < log.n_joints; ++k) {
      samples[i].motor_torque(k) = log.motor_torque[k][i];
      samples[i].motor_position(k) = log.motor_position[k][i];
    }
  }
  return samples;
}

/// The process model's step, sigma points one by one in scalar code.
class ScalarProcess final : public ArmProcess {
 public:
  using ArmProcess::ArmProcess;
  void advance(Eigen::MatrixXd& X) const override {
    for (Eigen::Index c = 0; c < X.cols(); ++c) model_.advance(step_, X.col(c).data());
  }
};

/// A variant: what one sample costs. Sample 0 starts anew.
struct Variant {
  std::string name;
  std::function<void(std::size_t)> step;
  std::vector<double> us = {};
};

StepTime summary(Variant& v) {
  std::sort(v.us.begin(), v.us.end());
  return {v.name, v.us[v.us.size() / 2], v.us[v.us.size() * 99 / 100]};
}

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

  for (int round = 0; round < rounds; ++round)
    for (std::size_t first = 0; first < samples.size(); first += kBlock)
      for (Variant& v : variants)
        for (std::size_t i = first; i < std::min(first + kBlock, samples.size()); ++i) {
          const Clock::time_point before = Clock::now();
          v.step(i);
          v.us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - before).count());
        }
  std::vector<StepTime> all;
  for (Variant& v : variants) all.push_back(summary(v));
  return all;
}

}  // namespace halyard
