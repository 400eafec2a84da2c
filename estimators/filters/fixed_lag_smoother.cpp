#include "estimators/filters/fixed_lag_smoother.h"

namespace halyard {

void smooth_backwards(const std::deque<FilteredBelief>& window,
                      const std::function<void(std::size_t, const Eigen::VectorXd&, const Eigen::MatrixXd&)>& visit) {
  if (window.empty()) return;
  LowerRoot root;
  Eigen::VectorXd x = window.back().x;
  Eigen::MatrixXd S = window.back().S;
  Eigen::MatrixXd columns(x.size(), 2 * x.size());
  for (std::size_t i = window.size(); i-- > 0;) {
    visit(i, x, S);
    if (i == 0) break;
    for (auto step = window[i].steps.rbegin(); step != window[i].steps.rend(); ++step) {
      x = step->x_0 + step->G * (x - step->x_predicted);
      columns.leftCols(x.size()).noalias() = step->G * S;
      columns.rightCols(x.size()) = step->V_root;
      root.compute(columns, S);
    }
  }
}

void FixedLagSmoother::RecordingUkf::predict(const DiscreteProcess& process, const Eigen::MatrixXd& Q_root) {
  const Eigen::VectorXd x_0 = x_;
  const Eigen::MatrixXd S_0 = S_;
  SquareRootUkf::predict(process, Q_root);
  steps.push_back(backward_step(x_0, S_0));
}

FixedLagSmoother::FixedLagSmoother(const ArmModel& model, std::shared_ptr<const ProcessModel> process,
                                   const ArmFilterOptions& options, const UkfWeights& weights, double lag_s)
    : FixedLagSmoother(model, std::move(process), options, std::make_unique<RecordingUkf>(weights), lag_s) {}

FixedLagSmoother::FixedLagSmoother(const ArmModel& model, std::shared_ptr<const ProcessModel> process,
                                   const ArmFilterOptions& options, std::unique_ptr<RecordingUkf> filter, double lag_s)
    : process_(std::move(process)),
      recorded_(filter.get()),
      filter_(model, process_, options, std::move(filter)),
      lag_s_(lag_s) {}

void FixedLagSmoother::reset(const Sample& first) {
  recorded_->steps.clear();
  window_.clear();
  due_.clear();
  filter_.reset(first);
  append(first.time_s);
}

Innovation FixedLagSmoother::update(const Sample& sample) {
  const Innovation innovation = filter_.update(sample);
  if (recorded_->steps.empty()) {  // the filter has started anew
    smooth(0);
    window_.clear();
  }
  append(sample.time_s);
  if (sample.time_s - window_.front().time_s >= 2 * lag_s_) smooth(lag_s_);
  return innovation;
}

void FixedLagSmoother::append(double time_s) {
  window_.push_back({time_s, recorded_->x(), recorded_->S(), std::move(recorded_->steps)});
  recorded_->steps.clear();
}

void FixedLagSmoother::smooth(double lag_s) {
  if (window_.empty()) return;
  const double until = window_.back().time_s - lag_s;
  std::deque<Revision> told;
  smooth_backwards(window_, [&](std::size_t i, const Eigen::VectorXd& x, const Eigen::MatrixXd& S) {
    if (window_[i].time_s <= until) told.push_front({window_[i].time_s, joint_estimate(process_->layout(), x, S)});
  });
  window_.erase(window_.begin(), window_.begin() + static_cast<std::ptrdiff_t>(told.size()));
  due_.insert(due_.end(), told.begin(), told.end());
}

std::optional<Revision> FixedLagSmoother::revise(bool at_end) {
  if (at_end) smooth(0);
  if (due_.empty()) return std::nullopt;
  Revision next = std::move(due_.front());
  due_.pop_front();
  return next;
}

}  // namespace halyard
