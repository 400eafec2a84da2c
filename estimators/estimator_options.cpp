#include "estimators/estimator_options.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "model/input/cell_text.h"
#include "model/input_error.h"
#include "model/output/number_text.h"

namespace halyard {
namespace {

std::string range_text(double lower, double upper) {
  if (std::isinf(upper)) return "of at least " + with_digits(lower, 6);
  return "from " + with_digits(lower, 6) + " to " + with_digits(upper, 6);
}

}  // namespace

OptionReader::OptionReader(std::string estimator, const EstimatorOptions& options)
    : estimator_(std::move(estimator)), options_(options) {}

void OptionReader::fail(const std::string& name, const std::string& text, const std::string& expected) const {
  throw InputError("estimator " + estimator_ + ": option " + name + " = " + in_quotes(text) + ": expected " + expected +
                   "; correct it, or leave the option out");
}

double OptionReader::number(const std::string& name, double standard, double lower, double upper) {
  known_.push_back(name);
  const auto found = options_.find(name);
  if (found == options_.end()) return standard;
  const std::optional<double> value = parse_number(trim(found->second));
  if (!value || !(*value >= lower) || !(*value <= upper))
    fail(name, found->second, "a number " + range_text(lower, upper));
  return *value;
}

Eigen::VectorXd OptionReader::per_joint(const std::string& name, const Eigen::VectorXd& standard, double lower,
                                        double upper) {
  known_.push_back(name);
  const auto found = options_.find(name);
  if (found == options_.end()) return standard;
  const Eigen::Index n = standard.size();
  const std::string expected = "one number, or one for each of the " + std::to_string(n) +
                               " joints with blanks between, " + range_text(lower, upper);
  std::istringstream words(found->second);
  std::vector<double> values;
  for (std::string word; words >> word;) {
    const std::optional<double> value = parse_number(word);
    if (!value || !(*value >= lower) || !(*value <= upper)) fail(name, found->second, expected);
    values.push_back(*value);
  }
  if (values.size() == 1) return Eigen::VectorXd::Constant(n, values[0]);
  if (static_cast<Eigen::Index>(values.size()) != n) fail(name, found->second, expected);
  return Eigen::Map<Eigen::VectorXd>(values.data(), n);
}

void OptionReader::finish() const {
  for (const auto& [name, text] : options_) {
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
    std::string list;
    for (const std::string& k : known_) list += (list.empty() ? "" : ", ") + k;
    throw InputError("estimator " + estimator_ + ": unknown option " + in_quotes(name) + "; " +
                     (list.empty() ? "it has no options" : "known are " + list));
  }
}

}  // namespace halyard
