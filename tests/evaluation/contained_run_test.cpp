/// Estimators in a process of their own: the same numbers as in this one, and nothing that they do ends this one.

#include "evaluation/run/contained_run.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <limits>
#include <new>
#include <system_error>
#include <thread>

#include "evaluation/worker/worker_process.h"
#include "model/input_error.h"
#include "model/model_file.h"
#include "plant/simulate.h"
#include "plugins/host/conformance.h"
#include "plugins/host/effect_module.h"
#include "plugins/host/loader.h"
#include "tests/plugins/broken/effects/spring_effect.h"
#include "tests/support/environment.h"
#include "tests/support/message_of.h"
#include "tests/support/plugin_fixtures.h"
#include "tests/support/temporary_folder.h"

namespace halyard {
namespace {

std::string fixture(const std::string& name) { return std::string(HALYARD_BROKEN_PLUGINS) + "/" + name + ".so"; }

ArmModel raven2() { return read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml"); }

/// 0.4 s of the bundled log, with samples missing.
Log some_log() {
  Log log = slice(read_log(HALYARD_SOURCE_DIR "/examples/raven2/undeclared_effect.csv", 3), 0, 200);
  log.source = "some.csv";
  log.motor_position[1][50] = log.motor_torque[0][60] = std::numeric_limits<double>::quiet_NaN();
  return log;
}

/// Equal to the last bit, NaN too.
bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

bool same(const Signals& a, const Signals& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) { return same(x, y); });
}

/// All but the wall time.
void expect_same(const EstimatorRun& a, const EstimatorRun& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_TRUE(same(a.estimates.time, b.estimates.time));
  EXPECT_TRUE(same(a.estimates.joint_position, b.estimates.joint_position));
  EXPECT_TRUE(same(a.estimates.joint_velocity, b.estimates.joint_velocity));
  EXPECT_TRUE(same(a.joint_position_std, b.joint_position_std));
  EXPECT_TRUE(same(a.innovation, b.innovation));
  EXPECT_TRUE(same(a.nis, b.nis));
  EXPECT_EQ(a.report.steps, b.report.steps);
  EXPECT_EQ(a.report.gated, b.report.gated);
  EXPECT_EQ(a.report.repaired_factors, b.report.repaired_factors);
  EXPECT_EQ(a.extra_output_names, b.extra_output_names);
  ASSERT_EQ(a.extra_outputs.size(), b.extra_outputs.size());
  for (std::size_t i = 0; i < a.extra_outputs.size(); ++i)
    EXPECT_TRUE(same(a.extra_outputs[i], b.extra_outputs[i])) << a.extra_output_names[i];
}

EstimatorRun run_here(const std::string& name, const ArmModel& model, const Log& log) {
  return run_estimator(*make_estimator(name, model), name, log);
}

/// What a run throws that fails without being refused.
std::string failure_of(const std::string& name, const ContainmentOptions& containment = {}) {
  try {
    run_contained(name, raven2(), some_log(), {}, containment);
  } catch (const InputError& error) {
    return std::string("InputError: ") + error.what();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no failure";
}

TEST(ContainedRun, GivesTheNumbersOfARunInThisProcessToTheLastBit) {
  const Log log = some_log();
  ArmModel model = raven2();
  model.nominal.joint[1].stiffness *= 1.0 / 3;  // a number that no file holds
  // disturbance_sr_ukf has extra outputs, smoother revises.
  for (const char* name : {"kinematics", "ekf", "disturbance_sr_ukf", "smoother"}) {
    SCOPED_TRACE(name);
    const EstimatorRun contained = run_contained(name, model, log), here = run_here(name, model, log);
    EXPECT_FALSE(std::isnan(here.estimates.joint_position[0].back()));
    expect_same(contained, here);
  }
}

TEST(ContainedRun, RefusesALogWithoutSamplesAsARunInThisProcessDoes) {
  const Log none = slice(some_log(), 0, 0);
  const std::string here = message_of([&] { run_here("ekf", raven2(), none); });
  EXPECT_EQ(message_of([&] { run_contained("ekf", raven2(), none); }), here);
  EXPECT_NE(here, "no InputError");
}

TEST(ContainedRun, HandsOnMeasuredLoadsIfAsked) {
  const ArmModel model = raven2();
  Log log = some_log();
  for (auto& column : log.joint_torque) column.assign(log.size(), 0.5);
  const EstimatorRun with = run_contained("ekf", model, log, {.use_joint_torque = true});
  EXPECT_TRUE(same(run_contained("ekf", model, log).estimates.joint_position,
                   run_contained("ekf", model, some_log()).estimates.joint_position));
  EXPECT_FALSE(same(with.estimates.joint_position, run_contained("ekf", model, log).estimates.joint_position));
  expect_same(with, run_estimator(*make_estimator("ekf", model), "ekf", log, {.use_joint_torque = true}));
}

TEST(ContainedRun, ACrashIsAFailureWithEstimatorLogAndTime) {
  const std::string crash = fixture("crashes_in_update");
  // Its second step, from sample 1 to 2, crashes.
  const std::string message = failure_of(crash);
  EXPECT_TRUE(message.starts_with("estimator " + crash + " on some.csv at 0.004 s: crashed: Segm")) << message;
}

TEST(ContainedRun, AHangIsEndedAfterTheLimitOfAStep) {
  const auto begin = std::chrono::steady_clock::now();
  const std::string hang = fixture("never_returns");
  EXPECT_EQ(failure_of(hang, {.step_limit_s = 0.5}),
            "estimator " + hang + " on some.csv at 0.004 s: took more than 0.5 s, and was ended");
  // Ample for a machine with other work; without the limit it would take for ever.
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
}

TEST(ContainedRun, AnEstimatorThatStopsItsSupervisorIsEndedAsWell) {
  const std::string stops = fixture("stops_its_parent");
  EXPECT_EQ(failure_of(stops, {.step_limit_s = 0.5}),
            "estimator " + stops + " on some.csv at 0.004 s: took more than 0.5 s, and was ended");
}

TEST(ContainedRun, AnEstimatorThatEndsItsProcessIsAFailure) {
  const std::string ends = fixture("ends_process");
  EXPECT_EQ(failure_of(ends), "estimator " + ends + " on some.csv at 0.004 s: ended its process");
}

TEST(ContainedRun, ARefusalIsTheInputErrorOfThisProcess) {
  ArmModel model = raven2();
  model.estimators["kinematics"]["colour"] = "blue";
  for (const char* name : {"kinematics", "no_such_estimator", "./no_such_module.so"}) {
    const auto refusal_of = [&](bool in_process) {
      return message_of([&] { check_estimator(name, model, {.in_process = in_process}); });
    };
    EXPECT_NE(refusal_of(true), "no InputError");
    EXPECT_EQ(refusal_of(false), refusal_of(true));
    EXPECT_EQ(message_of([&] { run_contained(name, model, some_log()); }), refusal_of(true));
  }
}

TEST(ContainedRun, TellsHowFarItIs) {
  Log log = some_log();
  const std::string slow = fixture("never_returns");  // its first step is done, the second is not
  std::vector<double> fractions;
  EXPECT_ANY_THROW(run_contained(slow, raven2(), log,
                                 {.progress = [&](double fraction) { fractions.push_back(fraction); }},
                                 {.step_limit_s = 0.5}));
  ASSERT_FALSE(fractions.empty());
  EXPECT_EQ(fractions.back(), 2.0 / 200);
}

TEST(ContainedRun, ExceptionsOfTheCallerEndTheWorker) {
  struct Stop {};
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THROW(run_contained(fixture("never_returns"), raven2(), some_log(), {.progress = [](double) { throw Stop(); }},
                             {.step_limit_s = 3600}),
               Stop);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60));
}

TEST(ContainedFaults, AreThoseFoundInThisProcess) {
  const std::string careless = fixture("careless");
  const std::vector<std::string> faults = conformance_faults(careless, raven2());
  EXPECT_FALSE(faults.empty());
  EXPECT_EQ(contained_faults(careless, raven2(), false), faults);
  EXPECT_EQ(contained_faults(careless, raven2(), false, {.in_process = true}), faults);
  EXPECT_EQ(contained_faults("ekf", raven2(), true, {.in_process = true}), std::vector<std::string>());
  EXPECT_EQ(contained_faults("ekf", raven2(), true), std::vector<std::string>());
  const std::vector<std::string> crash = contained_faults(fixture("crashes_in_update"), raven2(), false);
  ASSERT_EQ(crash.size(), 1u);
  EXPECT_TRUE(crash[0].starts_with("plain record: crashed: Segm")) << crash[0];
  EXPECT_TRUE(crash[0].ends_with(", the rest was not tried")) << crash[0];
}

/// A joint with the effect of the fixture, `name` as it is known.
ArmModel with_spring(const std::string& name) {
  ArmModel model = raven2();
  model.effects.push_back(place_effect(*find_effect(name), model.nominal, 0));
  return model;
}

TEST(ContainedRun, KnowsTheEffectsOfLoadedModules) {
  if (!find_effect("fixture_spring")) load_effects(fixture("effects_well_formed"));
  const ArmModel model = with_spring("fixture_spring");
  const EstimatorRun run = run_contained("ekf", model, some_log());
  expect_same(run, run_here("ekf", model, some_log()));
  EXPECT_FALSE(same(run.estimates.joint_position, run_here("ekf", raven2(), some_log()).estimates.joint_position));
}

class OwnSpring : public Spring {
 public:
  std::string name() const override { return "own_spring"; }
};

TEST(ContainedRun, RefusesAnEffectThatOnlyThisProgramKnows) {
  if (!find_effect("own_spring")) register_effect(std::make_unique<OwnSpring>());
  const ArmModel model = with_spring("own_spring");
  const std::string message = message_of([&] { run_contained("ekf", model, some_log()); });
  EXPECT_EQ(message,
            "estimator ekf: the process that runs it does not know the effect 'own_spring', which this program "
            "registered itself; put the effect into a module for load_effects(), or run the estimator in this process "
            "(ContainmentOptions::in_process)");
  expect_same(run_contained("ekf", model, some_log(), {}, {.in_process = true}), run_here("ekf", model, some_log()));
}

TEST(Worker, IsTheProgramThatTheEnvironmentNames) {
  const std::string worker = worker_program().string();
  {
    const Environment at("HALYARD_WORKER", "/no/such/program");
    EXPECT_EQ(message_of([] { check_estimator("ekf", raven2()); }),
              "HALYARD_WORKER: '/no/such/program' is no file; give the path of halyard_worker");
  }
  {
    const Environment at("HALYARD_WORKER", "/bin/false");
    EXPECT_EQ(message_of([] { check_estimator("ekf", raven2()); }),
              "/bin/false: cannot be started (exit code 1); install it again");
    std::vector<std::string> refused;
    EXPECT_EQ(message_of([&] { contained_plugins(&refused); }),
              "/bin/false: cannot be started (exit code 1); install it again")
        << "no module is to blame";
  }
  {
    const Environment at("HALYARD_WORKER", "/etc/passwd");
    EXPECT_EQ(message_of([] { check_estimator("ekf", raven2()); }),
              "HALYARD_WORKER: '/etc/passwd' cannot be run; give the path of halyard_worker");
  }
  const Environment at("HALYARD_WORKER", worker);
  EXPECT_NO_THROW(check_estimator("ekf", raven2()));
}

TEST(Worker, RefusesToBeStartedByHand) {
  const TemporaryFolder folder;
  const std::string said = folder / "worker_says";
  EXPECT_EQ(WEXITSTATUS(std::system((worker_program().string() + " 77 78 2>" + said).c_str())), 2);
  std::string line;
  std::getline(std::ifstream(said), line);
  EXPECT_EQ(line, "halyard_worker: is started by halyard's library only; run halyard instead");
}

TEST(Worker, WithoutAProcessForTheEstimatorIsAFaultOfTheMachine) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can become a user who may have two processes";
  constexpr uid_t kNobody = 64'321;
  const pid_t child = fork();  // single-threaded here
  if (child == 0) {
    const rlimit two{2, 2};  // this process and its worker
    if (setrlimit(RLIMIT_NPROC, &two) != 0 || setgid(kNobody) != 0 || setuid(kNobody) != 0) _exit(9);
    try {
      check_estimator("ekf", raven2());
    } catch (const std::system_error& error) {
      // Not that of the worker: "... cannot be started" with its path.
      const bool is_of_estimator =
          std::string(error.what()).starts_with("the process of an estimator cannot be started");
      _exit(error.code().value() == EAGAIN && is_of_estimator ? 0 : 1);
    } catch (const NoWorker&) {
      _exit(8);  // the build tree is closed to other users
    } catch (const std::exception&) {
      _exit(2);
    }
    _exit(3);
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WEXITSTATUS(status) >= 8) GTEST_SKIP() << "another user cannot start the worker";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(Worker, MemoryThatRunsOutIsNoFailureOfTheEstimator) {
  const std::string hungry = fixture("finds_no_memory");
  try {
    check_estimator(hungry, raven2());
    FAIL() << "no memory was there";
  } catch (const WorkerKilled& end) {
    EXPECT_EQ(end.what(),
              "estimator " + hungry +
                  ", being made: memory ran out; free memory, use fewer --jobs, or leave this estimator out");
  }
  EXPECT_TRUE(is_fault_of_the_machine(std::bad_alloc()));
}

TEST(Worker, ThatIsKilledIsAFaultOfTheMachine) {
  const std::string kills = fixture("kills_its_process");
  EXPECT_EQ(failure_of(kills), "estimator " + kills +
                                   " on some.csv at 0.004 s: its process was killed, probably because memory ran out; "
                                   "free memory, use fewer --jobs, or leave this estimator out");
  EXPECT_TRUE(is_fault_of_the_machine(WorkerKilled("")));
  EXPECT_FALSE(is_fault_of_the_machine(WorkerEnded("")));
}

TEST(Worker, DoesNotOutliveTheProcessThatStartedIt) {
  // A process of this test's own, whose estimator hangs; single-threaded here, so that fork is safe.
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t parent = fork();
  if (parent == 0) {
    const auto tell = [&](double) {
      std::string children;
      const std::string me = std::to_string(getpid());
      std::getline(std::ifstream("/proc/" + me + "/task/" + me + "/children"), children);
      const pid_t worker = std::atoi(children.c_str());
      if (write(ready[1], &worker, sizeof worker) != sizeof worker) _exit(1);
    };
    try {
      run_contained(fixture("never_returns"), raven2(), some_log(), {.progress = tell}, {.step_limit_s = 3600});
    } catch (const std::exception&) {}
    _exit(0);
  }
  pid_t worker = 0;
  ASSERT_EQ(read(ready[0], &worker, sizeof worker), static_cast<ssize_t>(sizeof worker));
  ASSERT_GT(worker, 0);
  ASSERT_EQ(kill(worker, 0), 0);
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  // Gone, or a zombie that whoever inherits orphans has not waited for.
  const auto runs = [&] {
    std::string stat;
    std::getline(std::ifstream("/proc/" + std::to_string(worker) + "/stat"), stat);
    return !stat.empty() && stat.find(") Z ") == stat.npos;
  };
  for (int i = 0; i < 1000 && runs(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(runs());
}

TEST(Worker, ManyAreStartedFromThreadsThatAllocateMemory) {
  const ArmModel model = raven2();
  const Log log = slice(some_log(), 0, 20);
  const EstimatorRun here = run_here("kinematics", model, log);
  tbb::parallel_for(0, 60, [&](int i) {
    if (i % 3 != 0) {
      std::vector<std::string> texts;
      for (int k = 0; k < 100000; ++k) texts.push_back(std::string(static_cast<std::size_t>(k % 200), 'x'));
      return;
    }
    const EstimatorRun run = run_contained("kinematics", model, log);
    EXPECT_TRUE(same(run.estimates.joint_position, here.estimates.joint_position));
  });
}

TEST(ContainedPlugins, OneThatCrashesAsItIsOpenedIsRefusedAsOthersAre) {
  const std::vector<PluginInfo> installed = find_plugins();
  const TemporaryFolder folder;
  for (const char* name : {"crashes_in_table", "well_formed"})
    std::filesystem::copy_file(fixture(name), folder / (std::string(name) + ".so"));
  const Environment path("HALYARD_PLUGIN_PATH", (folder / "").string().c_str());
  std::vector<std::string> refused;
  const std::vector<PluginInfo> found = contained_plugins(&refused);
  ASSERT_EQ(found.size(), installed.size() + 1);
  for (std::size_t i = 0; i < installed.size(); ++i) {
    EXPECT_EQ(found[i].name, installed[i].name);
    EXPECT_EQ(found[i].description, installed[i].description);
    EXPECT_EQ(found[i].path, installed[i].path);
  }
  EXPECT_EQ(found.back().name, "fixture");
  const std::string crashed = std::filesystem::canonical(folder / "crashes_in_table.so").string();
  EXPECT_EQ(refused, std::vector{"plugin " + crashed + ": as it is opened: crashed: Segmentation fault"});
}

TEST(ContainedPlugins, OneThatHangsAsItIsOpenedIsRefusedAfterTheLimit) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(fixture("hangs_when_opened"), folder / "hangs_when_opened.so");
  const Environment path("HALYARD_PLUGIN_PATH", (folder / "").string().c_str());
  std::vector<std::string> refused;
  // Ample for the start of a worker on a machine with other work.
  EXPECT_FALSE(contained_plugins(&refused, {.step_limit_s = 3}).empty());
  const std::string hangs = std::filesystem::canonical(folder / "hangs_when_opened.so").string();
  EXPECT_EQ(refused, std::vector{"plugin " + hangs + ": as it is opened: took more than 3 s, and was ended"});
}

}  // namespace
}  // namespace halyard
