#pragma once
/// For authors of estimators in C++: makes the table of halyard_estimator.h from a class. A module consists of the
/// class and one function:
///
///   extern "C" const halyard_estimator_table* halyard_estimator() {
///     static const auto table = halyard::estimator_table<MyEstimator>("my_estimator", "what it is, in one line");
///     return &table;
///   }
///
/// MyEstimator derives from halyard::Estimator (or from halyard::Observer, observer.h) and has a constructor with the
/// arguments (const ArmModel&, const EstimatorOptions&). A factory function can replace the class.
///
/// No exception leaves the module: InputError becomes HALYARD_REFUSED, any other exception HALYARD_FAILED. The message
/// is what().

#include <Eigen/Core>
#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "estimators/estimator.h"
#include "model/arm_model.h"
#include "model/input_error.h"
#include "model/model_file.h"
#include "plugins/halyard_estimator.h"
#include "plugins/host/eigen_alignment.h"

namespace halyard {

using EstimatorFactory = std::unique_ptr<Estimator> (*)(const ArmModel&, const EstimatorOptions&);

namespace plugin {

using Vector = Eigen::Map<Eigen::VectorXd>;
using ConstVector = Eigen::Map<const Eigen::VectorXd>;
using RowMajorMatrix = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

inline void copy_message(const char* text, char* message, std::size_t message_size) {
  if (message_size == 0) return;
  const std::size_t length = std::min(std::strlen(text), message_size - 1);
  std::memcpy(message, text, length);
  message[length] = '\0';
}

/// Runs body; an exception becomes a code and a message.
template <class Body>
int guarded(char* message, std::size_t message_size, const Body& body) noexcept {
  try {
    body();
    return HALYARD_OK;
  } catch (const InputError& error) {
    copy_message(error.what(), message, message_size);
    return HALYARD_REFUSED;
  } catch (const std::exception& error) {
    copy_message(error.what(), message, message_size);
  } catch (...) {
    copy_message("unknown exception", message, message_size);
  }
  return HALYARD_FAILED;
}

/// A C++ estimator behind the table's functions.
class Instance {
 public:
  Instance(std::unique_ptr<Estimator> estimator, std::size_t n_joints)
      : estimator_(std::move(estimator)), n_(static_cast<Eigen::Index>(n_joints)) {
    if (!estimator_) throw std::logic_error("the factory made no estimator");
    extra_output_names_ = estimator_->extra_output_names();
  }

  void reset(const halyard_sample& first) { estimator_->reset(take(first)); }

  void update(const halyard_sample& sample, halyard_innovation& out) {
    const Innovation innovation = estimator_->update(take(sample));
    const Eigen::Index m = innovation.nu.size();
    check(m <= n_, "nu", m);
    check(innovation.S_root.rows() == m && innovation.S_root.cols() == m, "S_root", innovation.S_root.rows());
    out.m = static_cast<std::size_t>(m);
    Vector(out.nu, m) = innovation.nu;
    RowMajorMatrix(out.S_root, m, m) = innovation.S_root;
    out.accepted = innovation.accepted;
  }

  void estimate(halyard_estimate& out) const { copy(estimator_->estimate(), out); }

  const char* extra_output_name(std::size_t i) const {
    return i < extra_output_names_.size() ? extra_output_names_[i].c_str() : nullptr;
  }

  void revise(bool at_end, double& time_s, halyard_estimate& out) {
    const std::optional<Revision> revision = estimator_->revise(at_end);
    time_s = revision ? revision->time_s : std::numeric_limits<double>::quiet_NaN();
    if (revision) copy(revision->estimate, out);
  }

  void report(halyard_report& out) const {
    const EstimatorReport report = estimator_->report();
    out.steps = report.steps;
    out.repaired_factors = report.repaired_factors;
    out.gated = report.gated;
  }

 private:
  const Sample& take(const halyard_sample& sample) {
    sample_.time_s = sample.time_s;
    sample_.motor_torque = ConstVector(sample.motor_torque, n_);
    sample_.motor_position = ConstVector(sample.motor_position, n_);
    sample_.joint_torque = ConstVector(sample.joint_torque, sample.joint_torque ? n_ : 0);
    sample_.marker = ConstVector(sample.marker, sample.marker ? 3 : 0);
    return sample_;
  }

  void copy(const Estimate& estimate, halyard_estimate& out) const {
    copy("joint_position", estimate.joint_position, out.joint_position);
    copy("joint_velocity", estimate.joint_velocity, out.joint_velocity);
    copy("joint_position_std", estimate.joint_position_std, out.joint_position_std);
    const auto names = static_cast<Eigen::Index>(extra_output_names_.size());
    if (estimate.extra_outputs.cols() != names)
      throw std::logic_error("extra_outputs has " + std::to_string(estimate.extra_outputs.cols()) + " columns for " +
                             std::to_string(names) + " names");
    for (Eigen::Index i = 0; i < names; ++i)
      copy(extra_output_names_[i].c_str(), estimate.extra_outputs.col(i), out.extra_outputs + i * n_);
  }

  void copy(const char* what, const Eigen::VectorXd& from, double* to) const {
    check(from.size() == n_, what, from.size());
    Vector(to, n_) = from;
  }

  void check(bool fits, const char* what, Eigen::Index size) const {
    if (fits) return;
    throw std::logic_error(std::string(what) + " has size " + std::to_string(size) + " for " + std::to_string(n_) +
                           " joints");
  }

  std::unique_ptr<Estimator> estimator_;
  Eigen::Index n_;
  std::vector<std::string> extra_output_names_;
  Sample sample_;
};

template <EstimatorFactory make>
int create(const halyard_config* config, void** instance, char* message, std::size_t message_size) noexcept {
  return guarded(message, message_size, [&] {
    check_eigen_alignment(EIGEN_DEFAULT_ALIGN_BYTES);
    EstimatorOptions options;
    for (std::size_t i = 0; i < config->n_options; ++i) options[config->option_names[i]] = config->option_values[i];
    const ArmModel model = parse_model(config->model_xml, config->model_source);
    *instance = new Instance(make(model, options), config->n_joints);
  });
}

inline void destroy(void* instance) noexcept { delete static_cast<Instance*>(instance); }

inline int reset(void* instance, const halyard_sample* first, char* message, std::size_t message_size) noexcept {
  return guarded(message, message_size, [&] { static_cast<Instance*>(instance)->reset(*first); });
}

inline int update(void* instance, const halyard_sample* sample, halyard_innovation* innovation, char* message,
                  std::size_t message_size) noexcept {
  return guarded(message, message_size, [&] { static_cast<Instance*>(instance)->update(*sample, *innovation); });
}

inline int estimate(void* instance, halyard_estimate* out, char* message, std::size_t message_size) noexcept {
  return guarded(message, message_size, [&] { static_cast<Instance*>(instance)->estimate(*out); });
}

inline int report(void* instance, halyard_report* out, char* message, std::size_t message_size) noexcept {
  return guarded(message, message_size, [&] { static_cast<Instance*>(instance)->report(*out); });
}

inline const char* extra_output_name(void* instance, std::size_t i) noexcept {
  return static_cast<Instance*>(instance)->extra_output_name(i);
}

inline int revise(void* instance, std::int32_t at_end, double* time_s, halyard_estimate* out, char* message,
                  std::size_t message_size) noexcept {
  return guarded(message, message_size, [&] { static_cast<Instance*>(instance)->revise(at_end != 0, *time_s, *out); });
}

template <class E>
std::unique_ptr<Estimator> construct(const ArmModel& model, const EstimatorOptions& options) {
  return std::make_unique<E>(model, options);
}

}  // namespace plugin

/// The table of the estimator that `make` creates. name and description must stay valid as long as the module is
/// loaded; use string literals.
template <EstimatorFactory make>
halyard_estimator_table estimator_table(const char* name, const char* description) {
  return {HALYARD_ESTIMATOR_INTERFACE,
          sizeof(halyard_estimator_table),
          name,
          description,
          plugin::create<make>,
          plugin::destroy,
          plugin::reset,
          plugin::update,
          plugin::estimate,
          plugin::report,
          plugin::extra_output_name,
          plugin::revise};
}

/// The same for a class E, made by its constructor.
template <class E>
halyard_estimator_table estimator_table(const char* name, const char* description) {
  return estimator_table<plugin::construct<E>>(name, description);
}

}  // namespace halyard
