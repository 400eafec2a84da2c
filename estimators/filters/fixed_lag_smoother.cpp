#include "estimators/filters/fixed_lag_smoother.h"

namespace halyard {

void BackwardPass::go_back_before(const BackwardStep& prediction) {
  const int n = prediction.G.rows(), others = prediction.V_root.columns();
  deviation_ = x_ - prediction.x_predicted;
  x_ = prediction.x_0;
  x_.noalias() += prediction.G.view() * deviation_;
  columns_.reshape(n, n + others);
  multiply(prediction.G.columns(0, n), right(S_), columns_.columns(0, n), false);
  set_block(prediction.V_root.view(), columns_.view().rightCols(others));
  root_.compute(columns_, S_.view());
}

void FixedLagSmoother::RecordingUkf::predict(const DiscreteProcess& process, const Eigen::MatrixXd& Q_root) {
  x_0_ = x_;
  S_0_ = S_;
  SquareRootUkf::predict(process, Q_root);
  backward_step(x_0_, S_0_, steps.append());
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
  known_steps_ = 0;
  window_.clear();
  due_.clear();
  filter_.reset(first);
  append(first.time_s);
}

Innovation FixedLagSmoother::update(const Sample& sample) {
  const Innovation innovation = filter_.update(sample);
  if (recorded_->steps.size() == known_steps_) {  // the filter has started anew
    smooth(0);
    window_.clear();
    recorded_->steps.clear();
    known_steps_ = 0;
  }
  append(sample.time_s);
  if (sample.time_s - window_.front().time_s >= 2 * lag_s_) smooth(lag_s_);
  return innovation;
}

void FixedLagSmoother::append(double time_s) {
  FilteredBelief& belief = window_.append();
  belief.time_s = time_s;
  belief.x = recorded_->x();
  belief.S = recorded_->root();
  belief.predictions = recorded_->steps.size() - known_steps_;
  known_steps_ = recorded_->steps.size();
}

void FixedLagSmoother::smooth(double lag_s) {
  if (window_.empty()) return;
  const double until = window_.back().time_s - lag_s;
  std::size_t ready = 0;
  while (ready < window_.size() && window_[ready].time_s <= until) ++ready;
  const std::size_t told = due_.size();
  for (std::size_t i = 0; i < ready; ++i) due_.append();
  pass_.start(window_.back());
  std::size_t step = known_steps_, removed = 0;
  for (std::size_t i = window_.size(); i-- > 0;) {
    if (i < ready) {
      Revision& revision = due_[told + i];
      revision.time_s = window_[i].time_s;
      set_joint_estimate(process_->layout(), pass_.x(), pass_.S(), revision.estimate);
    }
    if (i < ready) removed += window_[i].predictions;
    for (std::size_t k = 0; i > 0 && k < window_[i].predictions; ++k) pass_.go_back_before(recorded_->steps[--step]);
  }
  window_.remove_front(ready);
  recorded_->steps.remove_front(removed);
  known_steps_ -= removed;
}

std::optional<Revision> FixedLagSmoother::revise(bool at_end) {
  if (at_end) smooth(0);
  if (due_.empty()) return std::nullopt;
  Revision next = due_.front();
  due_.remove_front();
  return next;
}

}  // namespace halyard
