#include "estimators/identification/batch_estimate.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include "estimators/identification/filter_run.h"

namespace halyard {
namespace {

constexpr int kBlocks = 20;  // of a second or longer, where the logs are long enough
constexpr int kFewestBlocks = 6;
constexpr int kPasses = 8;
constexpr double kConvergedStep = 0.2;  // a step of fewer standard deviations is the last
constexpr double kFurthestStart = 3;    // prior deviations
constexpr double kWorse = 1;  // nats: a cost that rises by less is as good, as the steps leave out the derivative of S

/// What a pass over the logs with held weights tells. The blocks' sums are divided by `scale`.
struct Pass {
  std::vector<BlockSums> blocks;   ///< of equal times, without those that have no reading
  double misfit = 0, log_det = 0;  ///< Σ νᵀ S⁻¹ ν, Σ log |S_root|
  double prior = 0;                ///< |u|²
  double scale = 1;                ///< s²

  /// With an s² that stays the same from step to step.
  double cost(double held_scale) const { return 0.5 * misfit / held_scale + log_det + 0.5 * prior; }
};

Pass run_pass(const ArmModel& model, const std::vector<Weight>& weights, const Eigen::VectorXd& u,
              const std::vector<Log>& logs, double disturbances, const std::function<void(double)>& progress) {
  const double whole = duration_of(logs);
  const int count = std::clamp(static_cast<int>(whole), kFewestBlocks, kBlocks);
  const auto p = u.size();
  Pass pass;
  pass.blocks.assign(count, {Eigen::MatrixXd::Zero(p, p), Eigen::VectorXd::Zero(p)});
  pass.prior = u.squaredNorm();
  std::vector<Eigen::Index> readings(pass.blocks.size(), 0);
  DualUkf filter(model, weights, {.learn = false, .disturbances = disturbances});
  filter.set_weights(u, Eigen::MatrixXd::Identity(p, p));
  run_filter(filter, logs, progress, [&](const DualStep& step, double time) {
    if (step.nu.size() == 0) return;
    const auto b = static_cast<std::size_t>(std::min(static_cast<int>(time / whole * count), count - 1));
    BlockSums& block = pass.blocks[b];
    const auto S = step.S_root.triangularView<Eigen::Lower>();
    const Eigen::MatrixXd white = S.solve(step.Y);
    const Eigen::VectorXd white_nu = S.solve(step.nu);
    block.A.selfadjointView<Eigen::Lower>().rankUpdate(white.transpose());
    block.g += white.transpose() * white_nu;
    pass.misfit += white_nu.squaredNorm();
    pass.log_det += step.S_root.diagonal().array().abs().log().sum();
    readings[b] += white_nu.size();
  });
  const auto all = std::reduce(readings.begin(), readings.end());
  if (all > 0) pass.scale = std::max(1.0, pass.misfit / static_cast<double>(all));
  // A block within a pause, or within the settling time, tells nothing, and adds no degree of freedom.
  for (std::size_t b = readings.size(); b-- > 0;)
    if (readings[b] == 0) pass.blocks.erase(pass.blocks.begin() + static_cast<std::ptrdiff_t>(b));
  for (BlockSums& b : pass.blocks) {
    b.A = (b.A / pass.scale).selfadjointView<Eigen::Lower>();
    b.g /= pass.scale;
  }
  return pass;
}

/// Steps at one process noise after another. The passes over the logs are counted through.
class BlockSteps {
 public:
  BlockSteps(const ArmModel& model, const Unknowns& unknowns, const std::vector<Log>& logs,
             const std::function<void(int, double)>& progress)
      : model_(model), unknowns_(unknowns), logs_(logs), progress_(progress) {}

  /// From u, or from the model's numbers if the arm cannot be integrated at u.
  BatchEstimate from(Eigen::VectorXd u) {
    const int last = count_ + kPasses;
    std::optional<Pass> here = chosen_ ? std::exchange(chosen_, std::nullopt) : pass_if_integrable(u, disturbances_);
    if (!here) here = pass_at(u.setZero(), disturbances_);
    const Eigen::VectorXd bound = unknowns_.bound();
    BatchEstimate result;
    result.disturbances = disturbances_;
    for (;;) {
      result.estimate = jackknife_least_squares(here->blocks, u, bound);
      cost_ = here->cost(1);
      Eigen::VectorXd step = result.estimate.u - u;
      const Eigen::ArrayXd deviation = result.estimate.deviation.head(unknowns_.asked);
      result.innovation_size = std::sqrt(here->scale);
      result.converged = (step.head(unknowns_.asked).array().abs() <= kConvergedStep * deviation).all();
      if (result.converged) return result;
      std::optional<Pass> there;
      for (; count_ < last; step *= 0.5) {
        there = pass_if_integrable(u + step, disturbances_);
        if (there && there->cost(here->scale) <= here->cost(here->scale) + kWorse) break;
        there.reset();
      }
      if (!there) {
        result.estimate.u = u;
        return result;
      }
      u += step;
      here = std::move(there);
    }
  }

  /// Takes a smaller process noise if it explains the innovations at u, where the last steps ended, better; else false.
  bool choose_disturbances(const Eigen::VectorXd& u) {
    const double before = disturbances_;
    double least = cost_;
    for (const double factor : {0.3, 0.1, 0.03}) {
      if (factor >= before) continue;
      std::optional<Pass> pass = pass_if_integrable(u, factor);
      if (!pass || pass->cost(1) > least - kWorse) break;
      least = pass->cost(1);
      disturbances_ = factor;
      chosen_ = std::move(pass);
    }
    return disturbances_ != before;
  }

 private:
  Pass pass_at(const Eigen::VectorXd& u, double disturbances) {
    ++count_;
    return run_pass(model_, unknowns_.weights, u, logs_, disturbances,
                    [this](double fraction) { progress_(count_, fraction); });
  }
  std::optional<Pass> pass_if_integrable(const Eigen::VectorXd& u, double disturbances) {
    try {
      return pass_at(u, disturbances);
    } catch (const std::runtime_error&) {
      return std::nullopt;
    }
  }

  const ArmModel& model_;
  const Unknowns& unknowns_;
  const std::vector<Log>& logs_;
  const std::function<void(int, double)>& progress_;
  int count_ = 0;
  double disturbances_ = 1, cost_ = 0;
  std::optional<Pass> chosen_;  ///< where from() is to begin next
};

}  // namespace

BatchEstimate estimate_from_blocks(const ArmModel& model, const Unknowns& unknowns, const std::vector<Log>& logs,
                                   const Eigen::VectorXd& learnt_u, const std::function<void(int, double)>& progress) {
  BlockSteps steps(model, unknowns, logs, progress);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(unknowns.count());
  u.head(unknowns.learnt) = learnt_u.cwiseMax(-kFurthestStart).cwiseMin(kFurthestStart);
  BatchEstimate result = steps.from(u);
  while (steps.choose_disturbances(result.estimate.u)) result = steps.from(result.estimate.u);
  return result;
}

}  // namespace halyard
