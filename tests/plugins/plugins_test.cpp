// The boundary of plug-ins: what is refused, what is contained, and that nothing is changed on the way.
#include "plugins/host/loader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "estimators/built_in.h"
#include "model/input_error.h"
#include "model/model_file.h"
#include "plugins/halyard_estimator.h"
#include "plugins/host/conformance.h"
#include "transmission/coupling.h"

namespace fs = std::filesystem;
using halyard::ArmModel;
using halyard::InputError;
using halyard::Sample;

namespace {

const fs::path kFixtures = HALYARD_BROKEN_PLUGINS;

std::string fixture(const std::string& name) { return (kFixtures / (name + ".so")).string(); }

const ArmModel& raven2() {
  static const ArmModel model = halyard::read_model(fs::path(HALYARD_SOURCE_DIR) / "examples/raven2/raven2.xml");
  return model;
}

Sample sample_at(double time_s, double motor_position = 1) {
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

std::string refusal(const std::string& name_or_path, const ArmModel& model = raven2()) {
  return message_of<InputError>([&] { halyard::make_estimator(name_or_path, model); });
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

/// A folder that goes away with the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "halyard_plugins_test_XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TemporaryFolder() { fs::remove_all(path_); }
  operator const fs::path&() const { return path_; }
  fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

/// Sets HALYARD_PLUGIN_PATH until the end of the scope.
class PluginPath {
 public:
  explicit PluginPath(const std::string& folders) { setenv("HALYARD_PLUGIN_PATH", folders.c_str(), 1); }
  ~PluginPath() { unsetenv("HALYARD_PLUGIN_PATH"); }
};

}  // namespace

// The control of all that follows: the module that the broken ones are made from by one change each.
TEST(Plugins, AModuleInPlainCIsAnEstimator) {
  const auto estimator = halyard::make_estimator(fixture("well_formed"), raven2());
  estimator->reset(sample_at(0, 1));
  const halyard::Innovation innovation = estimator->update(sample_at(0.001, 1.25));
  EXPECT_EQ(innovation.time_s, 0.001);
  EXPECT_EQ(innovation.nu, Eigen::Vector3d::Constant(0.25));
  Eigen::Matrix3d S_root;  // row by row, as the contract says
  S_root << 1, 0, 0, 2, 2, 0, 3, 3, 3;
  EXPECT_EQ(innovation.S_root, S_root);
  EXPECT_TRUE(innovation.accepted);
  EXPECT_EQ(estimator->estimate().joint_position, Eigen::Vector3d::Constant(1.25));
  EXPECT_EQ(estimator->report().steps, 1);
  estimator->reset(sample_at(0, 2));
  EXPECT_EQ(estimator->estimate().joint_position, Eigen::Vector3d::Constant(2));
  EXPECT_EQ(estimator->report().steps, 0);
}

TEST(Plugins, WhatIsNoModuleIsRefusedInOneLine) {
  const TemporaryFolder folder;
  EXPECT_EQ(refusal("./nowhere.so"), "plugin ./nowhere.so: no such file; check the path");
  EXPECT_EQ(refusal("nowhere.so"), "plugin nowhere.so: no such file; check the path");
  EXPECT_EQ(refusal((folder / "").string()),
            "plugin " + (folder / "").string() + ": not a file; give the path of a module (.so)");
  EXPECT_EQ(
      refusal(fixture("not_an_elf")),
      "plugin " + fixture("not_an_elf") + ": not a shared module (ELF); give the path of a compiled plug-in (.so)");

  // A copy that was interrupted; loaded, it would end the process by SIGBUS.
  const std::string cut = folder / "cut.so";
  fs::copy_file(fixture("well_formed"), cut);
  fs::resize_file(cut, 5000);
  EXPECT_EQ(refusal(cut), "plugin " + cut + ": the file is cut short; build or copy it again");
}

TEST(Plugins, AModuleThatCannotBeLoadedIsRefusedWithTheLoadersReason) {
  EXPECT_EQ(refusal(fixture("undefined_symbol")),
            "plugin " + fixture("undefined_symbol") +
                ": cannot be loaded: undefined symbol: halyard_fixture_defined_nowhere; rebuild it, or install what it "
                "needs");
}

TEST(Plugins, TheHandshakeRefusesABrokenTableInOneLine) {
  const auto reason = [](const std::string& name) {
    const std::string message = refusal(fixture(name)), prefix = "plugin " + fixture(name) + ": ";
    EXPECT_TRUE(message.starts_with(prefix)) << message;
    return message.substr(std::min(prefix.size(), message.size()));
  };
  EXPECT_EQ(reason("missing_symbol"),
            "exports no function halyard_estimator; it is no estimator, or its function lacks extern \"C\"");
  EXPECT_EQ(reason("no_table"), "halyard_estimator() returns no table; return the address of a static one");
  EXPECT_EQ(reason("older_interface"),
            "built for interface 1, this program speaks 2; rebuild it against the installed headers");
  EXPECT_EQ(
      reason("newer_interface"),
      "built for interface 3, this program speaks 2; install a newer halyard, or rebuild it against these headers");
  const std::size_t size = sizeof(halyard_estimator_table);
  EXPECT_EQ(reason("small_table"), "its table has " + std::to_string(size - sizeof(void*)) +
                                       " bytes, interface 2 has " + std::to_string(size) +
                                       "; rebuild it against the installed headers");
  EXPECT_EQ(reason("missing_entry"), "its table lacks 'reset'; fill every entry");
  EXPECT_EQ(reason("missing_name"), "its table lacks 'name'; fill every entry");
  EXPECT_EQ(reason("path_for_a_name"),
            "its name 'a/b,c' cannot be used; name it with letters, digits, '_' and '-', at most 64");
}

TEST(Plugins, AModuleThatFlushesTinyNumbersToZeroIsRefusedAndTheModeRestored) {
  const std::string message = "plugin " + fixture("fast_math") +
                              ": changes the floating-point mode of the whole process when loaded; link it without "
                              "-ffast-math";
  volatile double smallest = std::numeric_limits<double>::min();
  for (int attempt = 0; attempt < 2; ++attempt) {  // a second load must not slip through because the first stayed
    EXPECT_EQ(refusal(fixture("fast_math")), message);
    EXPECT_GT(smallest / 2, 0) << "numbers below the smallest normal one are lost";
  }
}

TEST(Plugins, FailuresInCreateNameModelAndEstimator) {
  ArmModel model = raven2();
  model.source = "arm.xml";
  EXPECT_EQ(failure([&] { halyard::make_estimator(fixture("throws_in_create"), model); }),
            "arm.xml: estimator throws_in_create: the table of gains is lost");
  EXPECT_EQ(failure([&] { halyard::make_estimator(fixture("null_instance"), model); }),
            "arm.xml: estimator fixture: create makes no instance");

  model.estimators["throws_in_create"]["gain"] = "3";
  EXPECT_EQ(refusal(fixture("throws_in_create"), model),
            "arm.xml: estimator throws_in_create: option 'gain': unknown; there are none");
  model.estimators["fixture"]["gain"] = "3";
  EXPECT_EQ(refusal(fixture("well_formed"), model), "arm.xml: estimator fixture: has no options");
}

TEST(Plugins, FailuresAtWorkNamePluginAndTimeAndTheEstimatorStaysUsable) {
  const auto estimator = halyard::make_estimator(fixture("throws_in_update"), raven2());
  estimator->reset(sample_at(0));
  estimator->update(sample_at(0.001));
  EXPECT_EQ(failure([&] { estimator->update(sample_at(0.002)); }),
            "plugin throws_in_update: at 0.002 s: update: unknown exception");
  EXPECT_EQ(failure([&] { estimator->update(sample_at(0.003)); }),
            "plugin throws_in_update: at 0.003 s: update: the factor of the covariance is lost");
  estimator->reset(sample_at(0));
  EXPECT_NO_THROW(estimator->update(sample_at(0.001)));
}

TEST(Plugins, NumbersThatAreNotFiniteDoNotPass) {
  const auto estimator = halyard::make_estimator(fixture("not_finite"), raven2());
  estimator->reset(sample_at(0));
  estimator->update(sample_at(0.001));
  estimator->update(sample_at(0.002));
  EXPECT_NO_THROW(estimator->estimate());
  estimator->update(sample_at(12345.678));
  EXPECT_EQ(failure([&] { estimator->estimate(); }), "plugin fixture: at 12345.678 s: joint_velocity 3 is not finite");

  const auto innovation = halyard::make_estimator(fixture("well_formed"), raven2());
  innovation->reset(sample_at(0));
  EXPECT_EQ(failure([&] { innovation->update(sample_at(0.5, std::nan(""))); }),
            "plugin fixture: at 0.5 s: innovation 1 is not finite");
}

TEST(Plugins, ResultsThatBreakTheContractAreContained) {
  const auto at_work = [](const std::string& name) {
    return failure([&] {
      const auto estimator = halyard::make_estimator(fixture(name), raven2());
      estimator->reset(sample_at(0));
      estimator->update(sample_at(0.001));
      estimator->estimate();
    });
  };
  EXPECT_EQ(at_work("unknown_code"), "plugin fixture: at 0.001 s: update: returns the unknown code 7");
  EXPECT_EQ(at_work("too_many_innovations"), "plugin fixture: at 0.001 s: update: gives 4 innovations of 3 motors");
  EXPECT_EQ(at_work("forgets_std"), "plugin fixture: at 0.001 s: joint_position_std 1 is not finite");
  EXPECT_EQ(at_work("negative_std"), "plugin fixture: at 0.001 s: joint_position_std is negative");
  EXPECT_EQ(at_work("wrong_sizes"), "plugin wrong_sizes: at 0.001 s: estimate: joint_velocity has size 0 for 3 joints");
  EXPECT_EQ(at_work("lets_exceptions_out"),
            "plugin lets_exceptions_out: at 0.001 s: update: lets an exception out: nobody caught this");

  const std::string message = at_work("endless_message");
  EXPECT_TRUE(message.starts_with("plugin fixture: at 0.001 s: update: x xxxx")) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_LT(message.size(), 600u);
}

TEST(Plugins, TheCallersMistakesDoNotReachThePlugin) {
  const auto estimator = halyard::make_estimator(fixture("well_formed"), raven2());
  EXPECT_EQ(message_of<std::logic_error>([&] { estimator->update(sample_at(0)); }),
            "estimator fixture: update() before reset()");
  EXPECT_EQ(message_of<std::logic_error>([&] { estimator->estimate(); }),
            "estimator fixture: estimate() before reset()");
  Sample two_joints = sample_at(0);
  two_joints.motor_torque.resize(2);
  EXPECT_EQ(message_of<std::invalid_argument>([&] { estimator->reset(two_joints); }),
            "estimator fixture: the sample is not of 3 joints");
}

TEST(Plugins, FurtherEstimatesAndRevisionsCrossByNameAndTime) {
  EXPECT_EQ(halyard::make_estimator(fixture("well_formed"), raven2())->extra_output_names(),
            std::vector<std::string>());
  const auto estimator = halyard::make_estimator(fixture("looks_back"), raven2());
  EXPECT_EQ(estimator->extra_output_names(), (std::vector<std::string>{"twice", "none"}));
  estimator->reset(sample_at(0.5, 1));
  EXPECT_FALSE(estimator->revise(false).has_value());
  estimator->update(sample_at(0.75, 3));
  const Eigen::MatrixXd extra_outputs = estimator->estimate().extra_outputs;
  EXPECT_EQ(extra_outputs.col(0), Eigen::Vector3d::Constant(6));
  EXPECT_TRUE(extra_outputs.col(1).array().isNaN().all());
  const auto revision = estimator->revise(false);
  ASSERT_TRUE(revision.has_value());
  EXPECT_EQ(revision->time_s, 0.5);
  EXPECT_EQ(revision->estimate.joint_position, Eigen::Vector3d::Constant(2));  // between both readings
  EXPECT_FALSE(estimator->revise(false).has_value());
  EXPECT_EQ(failure([&] { halyard::make_estimator(fixture("taken_extra_output_name"), raven2()); }),
            "estimator fixture: extra output 'joint_position': the name is taken");
}

// Without the check the process dies when the module frees a vector that it got from the library.
TEST(Plugins, AModuleCompiledForOtherVectorsThanTheLibrariesIsRefused) {
#if defined(__x86_64__) && EIGEN_DEFAULT_ALIGN_BYTES == 16
  ArmModel model = raven2();
  model.source = "arm.xml";
  EXPECT_EQ(refusal(fixture("wide_vectors"), model),
            "arm.xml: estimator wide_vectors: compiled for vectors of 32 bytes, halyard's libraries for 16; compile "
            "the plug-in's files that include Eigen without -march or -mavx");
#else
  GTEST_SKIP() << "the fixture is compiled with -mavx, as this build is, or not for x86";
#endif
}

TEST(Plugins, AnEstimatorKeepsItsModuleOpen) {
  const TemporaryFolder folder;
  const fs::path path = folder / "short_lived.so";
  fs::copy_file(fixture("well_formed"), path);
  const auto is_loaded = [&] {
    std::ifstream maps("/proc/self/maps");
    const std::string all(std::istreambuf_iterator<char>(maps), {});
    return all.find("short_lived.so") != std::string::npos;
  };
  auto estimator = halyard::make_estimator(path.string(), raven2());
  auto second = halyard::make_estimator(path.string(), raven2());
  fs::remove(path);
  EXPECT_TRUE(is_loaded());
  second.reset();
  estimator->reset(sample_at(0, 1.5));
  EXPECT_EQ(estimator->estimate().joint_position(2), 1.5);
  estimator.reset();
  EXPECT_FALSE(is_loaded());
}

TEST(PluginSearch, FoldersOfTheUserComeLastAndTheFirstOfANameCounts) {
  const TemporaryFolder first, second;
  fs::copy_file(fixture("well_formed"), first / "fixture.so");
  fs::copy_file(fixture("well_formed"), second / "another_file.so");
  fs::copy_file(fixture("newer_interface"), second / "too_new.so");
  fs::copy_file(fixture("throws_in_update"), second / "throws_in_update.so");
  const PluginPath path((first / "").string() + ":" + (second / "").string() +
                        ":/no/such/folder:" + (first / "").string());

  std::vector<std::string> refused;
  std::vector<halyard::PluginInfo> found = halyard::find_plugins(&refused);
  ASSERT_GE(found.size(), 2u);
  EXPECT_EQ(found[found.size() - 2].name, "fixture");
  EXPECT_EQ(found[found.size() - 2].description, "joint position = motor position");
  EXPECT_EQ(found[found.size() - 2].path, fs::canonical(first / "fixture.so"));
  EXPECT_EQ(found.back().name, "throws_in_update");

  ASSERT_EQ(refused.size(), 3u);
  EXPECT_EQ(refused[0], "HALYARD_PLUGIN_PATH: '/no/such/folder' is no folder; correct it or take it out");
  EXPECT_EQ(refused[1], "plugin " + fs::canonical(second / "another_file.so").string() +
                            ": the name 'fixture' is taken by " + fs::canonical(first / "fixture.so").string() +
                            "; rename it, or call it by its path");
  EXPECT_EQ(refused[2], "plugin " + fs::canonical(second / "too_new.so").string() +
                            ": built for interface 3, this program speaks 2; install a newer halyard, or rebuild it "
                            "against these headers");
  EXPECT_NO_THROW(halyard::make_estimator("fixture", raven2()));
}

TEST(PluginSearch, AnUnknownNameListsTheKnownOnesAndSaysWhatWasRefused) {
  const TemporaryFolder folder;
  fs::copy_file(fixture("newer_interface"), folder / "wanted.so");
  const PluginPath path((folder / "").string());
  const std::string message = refusal("wanted");
  EXPECT_TRUE(message.starts_with("no estimator is named 'wanted' (plugin ")) << message;
  EXPECT_NE(message.find("built for interface 3, this program speaks 2"), std::string::npos) << message;
  EXPECT_TRUE(message.ends_with("; give one of these, or the path of a module such as ./wanted.so")) << message;
}

// The check must be able to fail.
TEST(Conformance, FindsWhatACarelessEstimatorBreaks) {
  EXPECT_EQ(halyard::conformance_faults(fixture("careless"), raven2()),
            (std::vector<std::string>{"report: counts 0 steps of 199", "reset: leaves something of the run before",
                                      "two instances: one of two, fed in turn, differs from one alone at sample 1",
                                      "unknown option: is not refused"}));
  // The first is where this fixture passes on what is missing.
  EXPECT_EQ(halyard::conformance_faults(fixture("well_formed"), raven2()).front(),
            "missing samples: plugin fixture: at 0.01 s: innovation 2 is not finite");
}

namespace {

struct BuiltIn {
  const char* name;
  std::unique_ptr<halyard::Estimator> (*make)(const ArmModel&, const halyard::EstimatorOptions&);
  halyard::EstimatorOptions options;
};

void PrintTo(const BuiltIn& built_in, std::ostream* out) { *out << built_in.name; }

class BuiltInPlugins : public testing::TestWithParam<BuiltIn> {};

INSTANTIATE_TEST_SUITE_P(
    All, BuiltInPlugins,
    testing::Values(BuiltIn{"sr_ukf", halyard::make_sr_ukf, {{"alpha", "0.01"}}},
                    BuiltIn{"disturbance_sr_ukf", halyard::make_disturbance_sr_ukf, {{"force_wander", "2"}}},
                    BuiltIn{"smoother", halyard::make_smoother, {{"lag", "0.01"}}},
                    BuiltIn{"camera_sr_ukf", halyard::make_camera_sr_ukf, {{"camera_latency", "0.01"}}},
                    BuiltIn{"ekf", halyard::make_ekf, {{"encoder_noise", "1e-4"}}},
                    BuiltIn{"kinematics", halyard::make_kinematics, {}}),
    [](const auto& info) { return info.param.name; });

}  // namespace

TEST_P(BuiltInPlugins, KeepWhatEveryEstimatorPromises) {
  EXPECT_EQ(halyard::conformance_faults(GetParam().name, raven2()), std::vector<std::string>());
}

// Model, options and samples cross as text and double*; no bit may be lost on the way.
TEST_P(BuiltInPlugins, GiveTheSameNumbersAsWithoutTheBoundary) {
  ArmModel model = raven2();
  model.nominal.joint[1].stiffness *= 1.0 / 3;
  model.effects.push_back(halyard::place_effect(*halyard::find_effect("backlash"), model.nominal, 1));
  model.estimators[GetParam().name] = GetParam().options;
  const auto direct = GetParam().make(model, GetParam().options);
  const auto plugin = halyard::make_estimator(GetParam().name, model);

  const Eigen::VectorXd at_home = halyard::unstretched_motors(model.nominal, model.home());
  for (int i = 0; i < 50; ++i) {
    Sample sample = sample_at(0.001 * i);
    sample.motor_position = at_home.array() + 0.1 * std::sin(0.05 * i);
    sample.motor_torque.setConstant(0.01 * std::cos(0.05 * i));
    if (i > 20) sample.joint_torque = Eigen::Vector3d(0.1, 0.2, 0.3);
    if (i % 7 == 3) sample.motor_position(1) = std::nan("");
    if (i % 10 == 9) sample.marker = Eigen::Vector3d(0.05, 0.02, -0.06);
    if (i == 0) {
      direct->reset(sample);
      plugin->reset(sample);
    } else {
      const halyard::Innovation a = direct->update(sample), b = plugin->update(sample);
      ASSERT_EQ(a.time_s, b.time_s);
      ASSERT_EQ(a.nu, b.nu);
      ASSERT_EQ(a.S_root, b.S_root);
      ASSERT_EQ(a.accepted, b.accepted);
    }
    const halyard::Estimate a = direct->estimate(), b = plugin->estimate();
    ASSERT_EQ(a.joint_position, b.joint_position);
    ASSERT_EQ(a.joint_velocity, b.joint_velocity);
    ASSERT_EQ(a.joint_position_std, b.joint_position_std);
    ASSERT_EQ(a.extra_outputs, b.extra_outputs);
    for (bool more = true; more;) {
      const auto c = direct->revise(i == 49), d = plugin->revise(i == 49);
      more = c.has_value();
      ASSERT_EQ(more, d.has_value());
      if (!more) continue;
      ASSERT_EQ(c->time_s, d->time_s);
      ASSERT_EQ(c->estimate.joint_position, d->estimate.joint_position);
      ASSERT_EQ(c->estimate.joint_position_std, d->estimate.joint_position_std);
    }
  }
  EXPECT_EQ(direct->extra_output_names(), plugin->extra_output_names());
  EXPECT_EQ(direct->report().steps, plugin->report().steps);
}

TEST_P(BuiltInPlugins, RefuseAnUnknownOptionByName) {
  ArmModel model = raven2();
  model.source = "arm.xml";
  model.estimators[GetParam().name]["alhpa"] = "1";
  const std::string start = std::string("arm.xml: estimator ") + GetParam().name + ": unknown option 'alhpa'; ";
  const std::string message = refusal(GetParam().name, model);
  EXPECT_TRUE(message.starts_with(start)) << message;
}

TEST(PluginSearch, FindsTheBuiltInEstimators) {
  std::vector<std::string> refused, names;
  for (const halyard::PluginInfo& plugin : halyard::find_plugins(&refused)) names.push_back(plugin.name);
  EXPECT_EQ(names, (std::vector<std::string>{"camera_sr_ukf", "disturbance_sr_ukf", "ekf", "kinematics", "smoother",
                                             "sr_ukf"}));
  EXPECT_EQ(refused, std::vector<std::string>());
  EXPECT_EQ(halyard::find_plugin("ekf").path.filename(), "ekf.so");
}
