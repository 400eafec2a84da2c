#pragma once
/// An estimator in a plug-in, behind the interface Estimator.

#include <memory>
#include <vector>

#include "estimators/estimator.h"
#include "model/arm_model.h"
#include "plugins/host/estimator_module.h"

namespace halyard {

/// Checks each result of the plug-in before it returns it. A failure throws `plugin NAME: at TIME s: what`: InputError
/// if the plug-in refuses its input, std::runtime_error for an error, an unknown code, an exception, numbers that are
/// not finite, and innovations without a deviation or of motors that were not measured. update() throws
/// std::invalid_argument, before it calls the plug-in, for a time that is not after that of the last sample.
class PluginEstimator : public Estimator {
 public:
  /// Keeps the module open as long as this object lives. Throws InputError `MODEL: estimator NAME: what` if the plug-in
  /// refuses the model or its options.
  PluginEstimator(std::shared_ptr<const EstimatorModule> module, const ArmModel& model);
  PluginEstimator(const PluginEstimator&) = delete;
  PluginEstimator& operator=(const PluginEstimator&) = delete;
  ~PluginEstimator() override;

  void reset(const Sample& first) override;
  Innovation update(const Sample& sample) override;
  Estimate estimate() const override;
  std::vector<std::string> extra_output_names() const override { return extra_output_names_; }
  std::optional<Revision> revise(bool at_end) override;
  EstimatorReport report() const override;

 private:
  halyard_sample take(const Sample& sample);
  /// Calls `fill`, a function of the table, and returns its estimate after the checks; none if `fill` returns false.
  template <class Fill>
  std::optional<Estimate> taken(const Fill& fill) const;
  template <class Call>
  void call(const char* function, const Call& call) const;
  void check_finite(const char* what, const double* values, Eigen::Index size) const;
  void destroy();
  [[noreturn]] void fail(const std::string& what) const;
  std::string where() const;

  std::shared_ptr<const EstimatorModule> module_;
  const halyard_estimator_table& table_;
  Eigen::Index n_;
  void* instance_ = nullptr;
  std::vector<std::string> extra_output_names_;
  bool started_ = false;
  double time_s_ = 0;
  std::vector<double> nu_, S_root_;
};

}  // namespace halyard
