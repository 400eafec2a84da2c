#pragma once
/// Fixed-lag smoother: estimates the joints with the help of later samples. The square-root unscented filter runs
/// forwards. A backward pass starts at the newest belief and goes back through the predictions p, one by one:
///
///   x_s = x_0 + G (x_s' - x⁻)                         x_s': smoothed mean at the end of p, x_s: at its start
///   S_s = triangular root of [G S_s', V]              x_0, x⁻, G, V: BackwardStep of p (gaussian_filter.h)
///
/// This is equivalent to P_s = P + G (P_s' - P⁻) Gᵀ, but it never subtracts one covariance from another. Whenever the
/// window of samples spans twice the lag, it is smoothed and the estimates of its older half are returned. So every
/// estimate uses all samples up to a time at least `lag` after it. The cost is two backward steps per sample. A window
/// also ends at a gap that restarts the filter and at the end of the record.
///
/// Source: Särkkä, "Unscented Rauch-Tung-Striebel smoother", IEEE Trans. Automatic Control 53 (2008); the root as in
/// Kailath, Sayed, Hassibi, "Linear Estimation", chapter 10.

#include <deque>
#include <functional>
#include <vector>

#include "estimators/filters/arm_filter.h"
#include "estimators/filters/sr_ukf.h"

namespace halyard {

/// The belief after a sample's correction, and the predictions that led to it from the belief before.
struct FilteredBelief {
  double time_s = 0;
  Eigen::VectorXd x;
  Eigen::MatrixXd S;
  std::vector<BackwardStep> steps;
};

/// Calls visit(i, x_s, S_s) for the beliefs of the window, from the last to the first. The last one stays as it is.
void smooth_backwards(const std::deque<FilteredBelief>& window,
                      const std::function<void(std::size_t, const Eigen::VectorXd&, const Eigen::MatrixXd&)>& visit);

class FixedLagSmoother final : public Estimator {
 public:
  FixedLagSmoother(const ArmModel& model, std::shared_ptr<const ProcessModel> process, const ArmFilterOptions& options,
                   const UkfWeights& weights, double lag_s);

  void reset(const Sample& first) override;
  Innovation update(const Sample& sample) override;
  /// The estimate of the forward filter, without later samples.
  Estimate estimate() const override { return filter_.estimate(); }
  std::optional<Revision> revise(bool at_end) override;
  EstimatorReport report() const override { return filter_.report(); }

 private:
  /// Keeps the BackwardStep of each prediction.
  class RecordingUkf final : public SquareRootUkf {
   public:
    using SquareRootUkf::SquareRootUkf;
    void predict(const DiscreteProcess& process, const Eigen::MatrixXd& Q_root) override;
    std::vector<BackwardStep> steps;
  };

  FixedLagSmoother(const ArmModel& model, std::shared_ptr<const ProcessModel> process, const ArmFilterOptions& options,
                   std::unique_ptr<RecordingUkf> filter, double lag_s);
  void append(double time_s);
  /// Smooths the window. Then moves to due_ the estimates that are at least `lag_s` older than the newest sample of the
  /// window.
  void smooth(double lag_s);

  std::shared_ptr<const ProcessModel> process_;
  RecordingUkf* recorded_;  // the filter inside filter_, which owns it
  ArmFilter filter_;
  double lag_s_;
  std::deque<FilteredBelief> window_;
  std::deque<Revision> due_;
};

}  // namespace halyard
