#pragma once
/// An estimator in C++ that behaves, for modules that each misbehave in one place.

#include "plugins/estimator_plugin.hpp"

class Behaving : public halyard::Estimator {
 public:
  Behaving(const halyard::ArmModel& model, const halyard::EstimatorOptions&) : n_(model.n()) {}
  void reset(const halyard::Sample&) override { steps_ = 0; }
  halyard::Innovation update(const halyard::Sample& sample) override {
    ++steps_;
    halyard::Innovation none;
    none.time_s = sample.time_s;
    return none;
  }
  halyard::Estimate estimate() const override {
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n_);
    return {zero, zero, zero};
  }
  halyard::EstimatorReport report() const override { return {steps_, 0, 0}; }

 private:
  int n_;
  long steps_ = 0;
};
