// The boundary of plug-ins: what is refused, what is contained, and that nothing is changed on the way.
#include "plugins/host/loader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>

#include "model/input_error.h"
#include "model/model_file.h"
#include "plugins/halyard_estimator.h"
#include "tests/support/plugin_fixtures.h"

namespace fs = std::filesystem;
using halyard::ArmModel;
using halyard::InputError;
using halyard::Sample;
using namespace halyard::plugin_fixtures;

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
  EXPECT_EQ(reason("throws_its_table"), "halyard_estimator() lets an exception out: no licence for tables");
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
  EXPECT_EQ(at_work("certain"),
            "plugin fixture: at 0.001 s: update: gives an innovation without a deviation: S_root has a diagonal that "
            "is not above 0");
  EXPECT_EQ(at_work("forgets_std"), "plugin fixture: at 0.001 s: joint_position_std 1 is not finite");
  EXPECT_EQ(at_work("negative_std"), "plugin fixture: at 0.001 s: joint_position_std is negative");
  EXPECT_EQ(at_work("wrong_sizes"), "plugin wrong_sizes: at 0.001 s: estimate: joint_velocity has size 0 for 3 joints");
  EXPECT_EQ(at_work("unnamed_extra_output"),
            "plugin unnamed_extra_output: at 0.001 s: estimate: extra_outputs has 2 columns for 0 names");
  EXPECT_EQ(at_work("infinite_extra_output"), "plugin fixture: at 0.001 s: gain 2 is infinite");

  const std::string message = at_work("endless_message");
  EXPECT_TRUE(message.starts_with("plugin fixture: at 0.001 s: update: x xxxx")) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_LT(message.size(), 600u);
}

TEST(Plugins, ExceptionsAndFailuresWithoutAWordAreContained) {
  const auto estimator = halyard::make_estimator(fixture("lets_exceptions_out"), raven2());
  estimator->reset(sample_at(0));
  EXPECT_EQ(failure([&] { estimator->update(sample_at(0.001)); }),
            "plugin lets_exceptions_out: at 0.001 s: update: lets an exception out: nobody caught this");
  EXPECT_EQ(failure([&] { estimator->update(sample_at(2)); }),
            "plugin lets_exceptions_out: at 2 s: update: lets an exception out");
  EXPECT_EQ(failure([&] { estimator->update(sample_at(3)); }),
            "plugin lets_exceptions_out: at 3 s: update: fails without a message");
}

TEST(Plugins, TheCallersMistakesDoNotReachThePlugin) {
  const auto estimator = halyard::make_estimator(fixture("well_formed"), raven2());
  EXPECT_EQ(message_of<std::logic_error>([&] { estimator->update(sample_at(0)); }),
            "estimator fixture: update() before reset()");
  EXPECT_EQ(message_of<std::logic_error>([&] { estimator->revise(true); }),
            "estimator fixture: revise() before reset()");
  EXPECT_EQ(message_of<std::logic_error>([&] { estimator->estimate(); }),
            "estimator fixture: estimate() before reset()");
  estimator->reset(sample_at(1, 1));
  estimator->update(sample_at(1.5, 2));
  for (const double time_s : {1.5, 1.2, std::nan("")}) {
    const std::string what = message_of<std::invalid_argument>([&] { estimator->update(sample_at(time_s, 3)); });
    EXPECT_TRUE(what.starts_with("estimator fixture: the sample's time ") && what.ends_with(" s is not after 1.5 s"))
        << what;
  }
  EXPECT_EQ(estimator->estimate().joint_position(0), 2) << "nothing has changed";
  const std::vector<std::function<void(Sample&)>> mistakes = {
      [](Sample& sample) { sample.motor_torque.setZero(2); }, [](Sample& sample) { sample.motor_position.setZero(2); },
      [](Sample& sample) { sample.joint_torque.setZero(2); }, [](Sample& sample) { sample.marker.setZero(2); }};
  for (const auto& mistake : mistakes) {
    Sample sample = sample_at(0);
    mistake(sample);
    EXPECT_EQ(message_of<std::invalid_argument>([&] { estimator->reset(sample); }),
              "estimator fixture: the sample is not of 3 joints");
  }
}

TEST(Plugins, ExtraOutputsAndRevisionsCrossByNameAndTime) {
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
}

TEST(Plugins, NamesOfExtraOutputsThatAreNoColumnsAreRefused) {
  const auto refused = [](const std::string& name) {
    return failure([&] { halyard::make_estimator(fixture(name), raven2()); });
  };
  EXPECT_EQ(refused("taken_extra_output_name"), "estimator fixture: extra output 'joint_position': the name is taken");
  EXPECT_EQ(refused("repeated_extra_output_name"), "estimator fixture: extra output 'gain': the name is taken");
  EXPECT_EQ(refused("spaced_extra_output_name"),
            "estimator fixture: extra output 'two words': its name has other than letters, digits, '_', '-'");
  EXPECT_EQ(refused("endless_extra_outputs"), "estimator fixture: extra output names do not end");
  EXPECT_EQ(refused("throws_its_names"),
            "estimator throws_its_names: extra output names: lets an exception out: no names today");
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
