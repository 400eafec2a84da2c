#pragma once
/// The modules of tests/plugins/broken, and what using one says.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "model/input_error.h"
#include "model/model_file.h"
#include "plugins/host/loader.h"
#include "tests/support/temporary_folder.h"

namespace halyard::plugin_fixtures {

namespace fs = std::filesystem;
using halyard::TemporaryFolder;

inline const fs::path kFixtures = HALYARD_BROKEN_PLUGINS;

inline std::string fixture(const std::string& name) { return (kFixtures / (name + ".so")).string(); }

inline const ArmModel& raven2() {
  static const ArmModel model = read_model(fs::path(HALYARD_SOURCE_DIR) / "examples/raven2/raven2.xml");
  return model;
}

inline Sample sample_at(double time_s, double motor_position = 1) {
  return {time_s, Eigen::VectorXd::Zero(3), Eigen::VectorXd::Constant(3, motor_position), Eigen::VectorXd()};
}

/// The message of the error that the call throws; other types of error fail the test.
template <class Error, class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

inline std::string refusal(const std::string& name_or_path, const ArmModel& model = raven2()) {
  return message_of<InputError>([&] { make_estimator(name_or_path, model); });
}

/// What an estimator at work is stopped by; InputError is none of these.
template <class Call>
std::string failure(const Call& call) {
  return message_of<std::runtime_error>([&] {
    try {
      call();
    } catch (const InputError& error) {
      ADD_FAILURE() << "InputError: " << error.what();
      throw;
    }
  });
}

}  // namespace halyard::plugin_fixtures
