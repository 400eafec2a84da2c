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

#include "estimators/filters/arm_filter.h"
#include "estimators/filters/sr_ukf.h"
#include "estimators/recycling_queue.h"

namespace halyard {

/// The belief after a sample's correction, and the number of predictions that led to it from the belief before.
struct FilteredBelief {
  double time_s = 0;
  Eigen::VectorXd x;
  LaneMatrix S;
  std::size_t predictions = 0;
};

/// The backward pass, x_s and S_s.
class BackwardPass {
 public:
  void start(const FilteredBelief& last) { x_ = last.x, S_ = last.S; }
  /// From the end of a prediction to its start.
  void go_back_before(const BackwardStep& prediction);
  const Eigen::VectorXd& x() const { return x_; }
  LaneMatrix::ConstView S() const { return S_.view(); }

 private:
  Eigen::VectorXd x_, deviation_;
  LaneMatrix S_, columns_;
  LowerRoot root_;
};

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
    RecyclingQueue<BackwardStep> steps;  ///< of all beliefs of the window and since

   private:
    Eigen::VectorXd x_0_;
    LaneMatrix S_0_;
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
  RecyclingQueue<FilteredBelief> window_;
  std::size_t known_steps_ = 0;  // of recorded_->steps: those of the beliefs in window_
  BackwardPass pass_;
  RecyclingQueue<Revision> due_;
};

}  // namespace halyard
