/// What a worker and the program that starts it say to each other: an answer is read as it was written, or refused.

#include "evaluation/worker/worker_task.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "evaluation/worker/bytes.h"
#include "tests/support/message_of.h"

namespace halyard {
namespace {

Log log_of_three_samples() {
  Log log(2);
  log.source = "log.csv";
  log.time = {0, 0.5, 1};
  return log;
}

EstimatorRun run_with_an_extra_output() {
  EstimatorRun run = no_run("mine", log_of_three_samples());
  run.estimates.joint_position = {{1, 2, 3}, {4, 5, 6}};
  run.estimates.joint_velocity = {{7, 8, 9}, {-1, -2, -3}};
  run.joint_position_std = {{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}};
  run.innovation = {{1, 0, 1}, {0, 1, 0}};
  run.nis = {0.5, 1, 2};
  run.report = {3, 2, 1};
  run.microseconds_per_step = 12.5;
  run.extra_output_names = {"force"};
  run.extra_outputs = {{{10, 20, 30}, {40, 50, 60}}};
  return run;
}

std::string failure_of(std::string_view bytes, const Log& log) {
  try {
    estimator_run_of(bytes, "mine", log);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "read";
}

TEST(WorkerAnswer, IsReadAsItWasWritten) {
  const EstimatorRun written = run_with_an_extra_output();
  const EstimatorRun read = estimator_run_of(estimator_run_bytes(written), "mine", log_of_three_samples());
  EXPECT_EQ(read.name, "mine");
  EXPECT_EQ(read.estimates.joint_position, written.estimates.joint_position);
  EXPECT_EQ(read.estimates.joint_velocity, written.estimates.joint_velocity);
  EXPECT_EQ(read.joint_position_std, written.joint_position_std);
  EXPECT_EQ(read.innovation, written.innovation);
  EXPECT_EQ(read.nis, written.nis);
  EXPECT_EQ(read.report.steps, 3);
  EXPECT_EQ(read.report.repaired_factors, 2);
  EXPECT_EQ(read.report.gated, 1);
  EXPECT_EQ(read.microseconds_per_step, 12.5);
  EXPECT_EQ(read.extra_output_names, written.extra_output_names);
  EXPECT_EQ(read.extra_outputs, written.extra_outputs);
}

TEST(WorkerAnswer, ThatEndsEarlyIsRefusedWhereverItEnds) {
  const std::string bytes = estimator_run_bytes(run_with_an_extra_output());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_EQ(failure_of(bytes.substr(0, size), log_of_three_samples()), "its process ended early") << size;
}

TEST(WorkerAnswer, OverAnotherLogIsRefused) {
  const std::string other = "its process gave a run over another log";
  Log log = log_of_three_samples();
  log.time.push_back(1.5);
  EXPECT_EQ(failure_of(estimator_run_bytes(run_with_an_extra_output()), log), other);
  Log of_three_joints(3);
  of_three_joints.time = {0, 0.5, 1};
  EXPECT_EQ(failure_of(estimator_run_bytes(run_with_an_extra_output()), of_three_joints), other);
  EstimatorRun run = run_with_an_extra_output();
  run.nis.pop_back();
  EXPECT_EQ(failure_of(estimator_run_bytes(run), log_of_three_samples()), other);
}

TEST(WorkerTask, OfAnotherVersionIsRefused) {
  ByteWriter bytes;
  bytes.count(1000000);
  const std::string message = message_of([&] { receive_worker_task(bytes.take()); });
  EXPECT_TRUE(message.starts_with("halyard_worker: speaks interface ")) << message;
  EXPECT_TRUE(message.ends_with(", the program that uses it 1000000; install both from one version of halyard"))
      << message;
}

}  // namespace
}  // namespace halyard
