#pragma once
/// Options of estimators that a sweep may vary, by key: estimator.NAME.OPTION, such as estimator.sr_ukf.alpha. They are
/// those of <estimator name="NAME" OPTION=""/> in a model file; an option that is given for each joint there gets one
/// number for all joints.

#include <optional>
#include <string>
#include <string_view>

#include "model/arm_model.h"

namespace halyard {

struct EstimatorOptionKey {
  std::string estimator, option;
};

/// Nothing if the key does not start with "estimator.". Throws InputError if it does and has not this form.
std::optional<EstimatorOptionKey> parse_option_key(std::string_view key);

/// The option's number in the model; nothing if the model does not give it, or not as one number.
std::optional<double> option_number(const ArmModel& model, const EstimatorOptionKey& key);

void set_option(ArmModel& model, const EstimatorOptionKey& key, double value);

}  // namespace halyard
