#pragma once
/// Adapts an arm's process model to the interfaces of gaussian_filter.h: one step, and the motors' readings.

#include <string>
#include <vector>

#include "estimators/filters/gaussian_filter.h"
#include "estimators/process/exponential_step.h"
#include "estimators/process/process_model.h"
#include "model/output/number_text.h"

namespace halyard {

/// f over one step: by `exponential`, which has been started at the mean of the belief, where its guard accepts that;
/// else by the process model's sub-steps. Both must outlive this object.
class ArmProcess : public DiscreteProcess {
 public:
  ArmProcess(const ProcessModel& model, const Step& step, ExponentialStep* exponential = nullptr)
      : model_(model), step_(step), exponential_(exponential) {}
  void advance(Eigen::MatrixXd& X) const override { model_.advance_many(step_, X); }
  void advance_with_jacobian(Eigen::VectorXd& x, Eigen::MatrixXd& F) const override {
    model_.advance_with_jacobian(step_, x.data(), F);
  }
  bool advance_root(Eigen::VectorXd& x, LaneMatrix& FS) const override {
    return exponential_ && exponential_->advance_root(x, FS);
  }
  bool advance_pairs(Eigen::VectorXd& x, const LaneMatrix& S, double gamma, LaneMatrix& FS,
                     Eigen::VectorXd& shift) const override {
    return exponential_ && exponential_->advance_pairs(x, S, gamma, FS, shift);
  }
  void transition(const Eigen::VectorXd& x_0, LaneMatrix& F) const override {
    if (exponential_ && exponential_->transition(F)) return;
    Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxStates, 1> x = x_0;
    F.reshape(model_.n_states(), model_.n_states());
    model_.advance_with_jacobian(step_, x.data(), F.view());
  }
  std::string name_of(int state) const override {
    return model_.state_name(state) + " at " + with_digits(step_.time_s + step_.dt_s, 12) + " s";
  }

 protected:
  const ProcessModel& model_;
  Step step_;
  ExponentialStep* exponential_;
};

/// h for some of the motors, given by the 0-based indices of their joints, in ascending order. The process model and
/// the indices must outlive this object.
class MotorReadings final : public MeasurementModel {
 public:
  MotorReadings(const ProcessModel& model, double time_s, const std::vector<int>& motors)
      : model_(model), time_(time_s), motors_(motors) {}
  bool is_affine() const override { return model_.readings_are_linear(); }
  void read(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Ref<Eigen::VectorXd> z) const override {
    AllReadings all(model_.n_joints());
    model_.read(time_, x, all);
    for (std::size_t i = 0; i < motors_.size(); ++i) z(static_cast<Eigen::Index>(i)) = all(motors_[i]);
  }
  void linearise(const Eigen::VectorXd& x, Eigen::Ref<Eigen::VectorXd> z,
                 Eigen::Ref<Eigen::MatrixXd> H) const override {
    if (z.size() == model_.n_joints()) return model_.linearise_readings(time_, x, z, H);
    AllReadings all(model_.n_joints());
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxJoints, kMaxStates> slopes(
        model_.n_joints(), model_.n_states());
    model_.linearise_readings(time_, x, all, slopes);
    for (Eigen::Index i = 0; i < z.size(); ++i) {
      const int k = motors_[static_cast<std::size_t>(i)];
      z(i) = all(k);
      H.row(i) = slopes.row(k);
    }
  }

 private:
  using AllReadings = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxJoints, 1>;

  const ProcessModel& model_;
  double time_;
  const std::vector<int>& motors_;
};

}  // namespace halyard
