#include "plugins/host/plugin_estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

#include "model/input_error.h"
#include "model/model_file.h"
#include "model/output/number_text.h"
#include "plugins/host/plain_name.h"

namespace halyard {
namespace {

/// A number that the plug-in leaves out must not pass for one that it gave.
constexpr double kUnset = std::numeric_limits<double>::quiet_NaN();

std::string seconds(double time_s) { return with_digits(time_s, 9); }

/// What a call into the module came to. An exception that it lets out is against the contract, and is contained.
struct Outcome {
  int code = HALYARD_FAILED;
  std::string message;
};

template <class Call>
Outcome run(const Call& call) {
  char message[512] = "";
  Outcome outcome;
  try {
    outcome.code = call(message, sizeof message);
    message[sizeof message - 1] = '\0';
    outcome.message = one_line(message);
  } catch (const std::exception& error) {
    outcome.message = one_line(std::string("lets an exception out: ") + error.what());
  } catch (...) {
    outcome.message = "lets an exception out";
  }
  // No failure of the estimator. The interface has no code for it: estimator_plugin.hpp passes what() on.
  if (outcome.code == HALYARD_FAILED && outcome.message == std::bad_alloc().what()) throw std::bad_alloc();
  if (outcome.code != HALYARD_OK && outcome.message.empty()) outcome.message = "fails without a message";
  if (outcome.code < HALYARD_OK || outcome.code > HALYARD_FAILED)
    outcome.message = "returns the unknown code " + std::to_string(outcome.code);
  return outcome;
}

void* create(const halyard_estimator_table& table, const ArmModel& model) {
  std::vector<const char*> names, values;
  if (const auto options = model.estimators.find(table.name); options != model.estimators.end()) {
    for (const auto& [name, value] : options->second) {
      names.push_back(name.c_str());
      values.push_back(value.c_str());
    }
  }
  const std::string xml = model_to_xml(model);
  const halyard_config config = {xml.c_str(),  model.source.c_str(), static_cast<std::size_t>(model.n()),
                                 names.size(), names.data(),         values.data()};
  void* instance = nullptr;
  const Outcome outcome =
      run([&](char* message, std::size_t size) { return table.create(&config, &instance, message, size); });
  if (outcome.code == HALYARD_OK && instance) return instance;

  const std::string self = std::string("estimator ") + table.name + ": ";
  std::string message = model.source.empty() ? "" : model.source + ": ";
  if (!outcome.message.starts_with(self)) message += self;  // estimators that also serve without a plug-in say it
  message += outcome.code == HALYARD_OK ? "create makes no instance" : outcome.message;
  if (outcome.code == HALYARD_REFUSED) throw InputError(message);
  throw std::runtime_error(message);
}

std::vector<std::string> extra_output_names_of(const halyard_estimator_table& table, void* instance) {
  constexpr std::size_t kMaxNames = 100;  // an end that never comes
  std::vector<std::string> names;
  const std::string start = std::string("estimator ") + table.name + ": extra output ";
  for (std::size_t i = 0; table.extra_output_name; ++i) {
    const char* name = nullptr;
    const Outcome asked = run([&](char*, std::size_t) {
      name = table.extra_output_name(instance, i);
      return HALYARD_OK;
    });
    if (asked.code != HALYARD_OK) throw std::runtime_error(start + "names: " + asked.message);
    if (!name) break;
    if (i == kMaxNames) throw std::runtime_error(start + "names do not end");
    const bool taken = name == std::string("joint_position") || name == std::string("joint_velocity") ||
                       name == std::string("joint_position_std") ||
                       std::find(names.begin(), names.end(), name) != names.end();
    if (!is_plain_name(name) || taken)
      throw std::runtime_error(start + in_quotes(name) +
                               (taken ? ": the name is taken" : ": its name has other than letters, digits, '_', '-'"));
    names.push_back(name);
  }
  return names;
}

}  // namespace

PluginEstimator::PluginEstimator(std::shared_ptr<const EstimatorModule> module, const ArmModel& model)
    : module_(std::move(module)),
      table_(module_->table()),
      n_(model.n()),
      instance_(create(table_, model)),
      nu_(static_cast<std::size_t>(n_)),
      S_root_(static_cast<std::size_t>(n_ * n_)) {
  try {
    extra_output_names_ = extra_output_names_of(table_, instance_);
  } catch (...) {
    destroy();
    throw;
  }
}

PluginEstimator::~PluginEstimator() { destroy(); }

void PluginEstimator::destroy() {
  // There is no one left to tell.
  run([&](char*, std::size_t) { return table_.destroy(instance_), HALYARD_OK; });
}

void PluginEstimator::reset(const Sample& first) {
  const halyard_sample sample = take(first);
  call("reset", [&](char* message, std::size_t size) { return table_.reset(instance_, &sample, message, size); });
  started_ = true;
}

Innovation PluginEstimator::update(const Sample& next) {
  if (!started_) throw std::logic_error("estimator " + std::string(table_.name) + ": update() before reset()");
  if (!(next.time_s > time_s_))
    throw std::invalid_argument("estimator " + std::string(table_.name) + ": the sample's time " +
                                seconds(next.time_s) + " s is not after " + seconds(time_s_) + " s");
  const halyard_sample sample = take(next);
  std::fill(nu_.begin(), nu_.end(), kUnset);
  std::fill(S_root_.begin(), S_root_.end(), kUnset);
  halyard_innovation out = {0, nu_.data(), S_root_.data(), 1};
  call("update",
       [&](char* message, std::size_t size) { return table_.update(instance_, &sample, &out, message, size); });

  if (out.m > nu_.size())
    fail("update: gives " + std::to_string(out.m) + " innovations of " + std::to_string(n_) + " motors");
  const auto m = static_cast<Eigen::Index>(out.m);
  check_finite("innovation", nu_.data(), m);
  Innovation innovation;
  // Above the diagonal nothing is written.
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  innovation.S_root = Eigen::Map<const RowMajor>(S_root_.data(), m, m).triangularView<Eigen::Lower>();
  check_finite("root of the innovation's covariance", innovation.S_root.data(), m * m);
  const Eigen::Index measured = (!next.motor_position.array().isNaN()).count();
  if (m > measured)
    fail("update: gives " + std::to_string(m) + " innovations where " + std::to_string(measured) +
         " motors have a position");
  innovation.time_s = next.time_s;
  innovation.nu = Eigen::Map<const Eigen::VectorXd>(nu_.data(), m);
  if (m > 0 && !(innovation.S_root.diagonal().minCoeff() > 0))
    fail("update: gives an innovation without a deviation: S_root has a diagonal that is not above 0");
  innovation.accepted = out.accepted != 0;
  return innovation;
}

Estimate PluginEstimator::estimate() const {
  if (!started_) throw std::logic_error("estimator " + std::string(table_.name) + ": estimate() before reset()");
  return *taken([&](halyard_estimate& out) {
    call("estimate", [&](char* message, std::size_t size) { return table_.estimate(instance_, &out, message, size); });
    return true;
  });
}

std::optional<Revision> PluginEstimator::revise(bool at_end) {
  if (!started_) throw std::logic_error("estimator " + std::string(table_.name) + ": revise() before reset()");
  if (!table_.revise) return std::nullopt;
  double time_s = kUnset;
  const std::optional<Estimate> estimate = taken([&](halyard_estimate& out) {
    call("revise", [&](char* message, std::size_t size) {
      return table_.revise(instance_, at_end ? 1 : 0, &time_s, &out, message, size);
    });
    return !std::isnan(time_s);
  });
  if (!estimate) return std::nullopt;
  return Revision{time_s, *estimate};
}

template <class Fill>
std::optional<Estimate> PluginEstimator::taken(const Fill& fill) const {
  const Eigen::VectorXd unset = Eigen::VectorXd::Constant(n_, kUnset);
  Estimate result{unset, unset, unset,
                  Eigen::MatrixXd::Constant(n_, static_cast<Eigen::Index>(extra_output_names_.size()), kUnset)};
  halyard_estimate out = {result.joint_position.data(), result.joint_velocity.data(), result.joint_position_std.data(),
                          result.extra_outputs.data()};
  if (!fill(out)) return std::nullopt;
  check_finite("joint_position", result.joint_position.data(), n_);
  check_finite("joint_velocity", result.joint_velocity.data(), n_);
  check_finite("joint_position_std", result.joint_position_std.data(), n_);
  if (n_ > 0 && result.joint_position_std.minCoeff() < 0) fail("joint_position_std is negative");
  for (Eigen::Index i = 0; i < result.extra_outputs.cols(); ++i)
    for (Eigen::Index k = 0; k < n_; ++k)
      if (std::isinf(result.extra_outputs(k, i)))
        fail(extra_output_names_[i] + " " + std::to_string(k + 1) + " is infinite");
  return result;
}

EstimatorReport PluginEstimator::report() const {
  halyard_report out = {0, 0, 0};
  call("report", [&](char* message, std::size_t size) { return table_.report(instance_, &out, message, size); });
  EstimatorReport report;
  report.steps = out.steps;
  report.repaired_factors = out.repaired_factors;
  report.gated = out.gated;
  return report;
}

halyard_sample PluginEstimator::take(const Sample& sample) {
  const Eigen::Index loads = sample.joint_torque.size();
  if (sample.motor_torque.size() != n_ || sample.motor_position.size() != n_ || (loads != 0 && loads != n_) ||
      (sample.marker.size() != 0 && sample.marker.size() != 3))
    throw std::invalid_argument("estimator " + std::string(table_.name) + ": the sample is not of " +
                                std::to_string(n_) + " joints");
  time_s_ = sample.time_s;
  return {sample.time_s, sample.motor_torque.data(), sample.motor_position.data(),
          loads == 0 ? nullptr : sample.joint_torque.data(),
          sample.marker.size() == 0 ? nullptr : sample.marker.data()};
}

template <class Call>
void PluginEstimator::call(const char* function, const Call& call) const {
  const Outcome outcome = run(call);
  if (outcome.code == HALYARD_OK) return;
  if (outcome.code == HALYARD_REFUSED) throw InputError(where() + outcome.message);
  fail(std::string(function) + ": " + outcome.message);
}

void PluginEstimator::check_finite(const char* what, const double* values, Eigen::Index size) const {
  for (Eigen::Index i = 0; i < size; ++i) {
    if (std::isfinite(values[i])) continue;
    fail(std::string(what) + " " + std::to_string(i + 1) + " is not finite");
  }
}

void PluginEstimator::fail(const std::string& what) const { throw std::runtime_error(where() + what); }

std::string PluginEstimator::where() const {
  return "plugin " + std::string(table_.name) + ": at " + seconds(time_s_) + " s: ";
}

}  // namespace halyard
