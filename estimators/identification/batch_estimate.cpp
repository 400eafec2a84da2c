#include "estimators/identification/batch_estimate.h"

#include <algorithm>
#include <cmath>
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
  std::vector<BlockSums> blocks;
  double misfit = 0, log_det = 0;  ///< Σ νᵀ S⁻¹ ν, Σ log |S_root|
  double prior = 0;                ///< |u|²
  double scale = 1;                ///< s²

  /// With an s² that stays the same from step to step.
  double cost(double held_scale) const { return 0.5 * misfit / held_scale + log_det + 0.5 * prior; }
};

Pass run_pass(const ArmModel& model, const std::vector<Weight>& weights, const Eigen::VectorXd& u,
              const std::vector<Log>& logs, const std::function<void(double)>& progress) {
  const double whole = duration_of(logs);
  const int count = std::clamp(static_cast<int>(whole), kFewestBlocks, kBlocks);
  const auto p = u.size();
  Pass pass;
  pass.blocks.assign(count, {Eigen::MatrixXd::Zero(p, p), Eigen::VectorXd::Zero(p)});
  pass.prior = u.squaredNorm();
  Eigen::Index readings = 0;
  DualUkf filter(model, weights, {.learn = false});
  filter.set_weights(u, Eigen::MatrixXd::Identity(p, p));
  run_filter(filter, logs, progress, [&](const DualStep& step, double time) {
    if (step.nu.size() == 0) return;
    BlockSums& block = pass.blocks[std::min(static_cast<int>(time / whole * count), count - 1)];
    const auto S = step.S_root.triangularView<Eigen::Lower>();
    const Eigen::MatrixXd white = S.solve(step.Y);
    const Eigen::VectorXd white_nu = S.solve(step.nu);
    block.A.selfadjointView<Eigen::Lower>().rankUpdate(white.transpose());
    block.g += white.transpose() * white_nu;
    pass.misfit += white_nu.squaredNorm();
    pass.log_det += step.S_root.diagonal().array().abs().log().sum();
    readings += white_nu.size();
  });
  if (readings > 0) pass.scale = std::max(1.0, pass.misfit / static_cast<double>(readings));
  for (BlockSums& b : pass.blocks) {
    b.A = (b.A / pass.scale).selfadjointView<Eigen::Lower>();
    b.g /= pass.scale;
  }
  return pass;
}

}  // namespace

BatchEstimate estimate_from_blocks(const ArmModel& model, const Unknowns& unknowns, const std::vector<Log>& logs,
                                   const Eigen::VectorXd& learnt_u, const std::function<void(int, double)>& progress) {
  int count = 0;
  const auto pass_at = [&](const Eigen::VectorXd& u) {
    ++count;
    return run_pass(model, unknowns.weights, u, logs, [&](double fraction) { progress(count, fraction); });
  };
  const auto pass_if_integrable = [&](const Eigen::VectorXd& u) -> std::optional<Pass> {
    try {
      return pass_at(u);
    } catch (const std::runtime_error&) {
      return std::nullopt;
    }
  };

  Eigen::VectorXd u = Eigen::VectorXd::Zero(unknowns.count());
  u.head(unknowns.learnt) = learnt_u.cwiseMax(-kFurthestStart).cwiseMin(kFurthestStart);
  std::optional<Pass> here = pass_if_integrable(u);
  if (!here) here = pass_at(u.setZero());

  const Eigen::VectorXd bound = unknowns.bound();
  BatchEstimate result;
  for (;;) {
    result.estimate = jackknife_least_squares(here->blocks, u, bound);
    Eigen::VectorXd step = result.estimate.u - u;
    const Eigen::ArrayXd deviation = result.estimate.deviation.head(unknowns.asked);
    result.innovation_size = std::sqrt(here->scale);
    result.converged = (step.head(unknowns.asked).array().abs() <= kConvergedStep * deviation).all();
    if (result.converged) return result;
    std::optional<Pass> there;
    for (; count < kPasses; step *= 0.5) {
      there = pass_if_integrable(u + step);
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

}  // namespace halyard
