// Runs that end while their outputs are half written under temporary names: by a signal, or killed.
#include <gtest/gtest.h>

#include "tests/app/faults/faults.h"

namespace halyard::testing_program {
namespace {

class FaultsWhileWriting : public Faults {
 protected:
  /// A file that the command writes late.
  static std::string late_file(const Arguments& command) {
    const fs::path out = command.back();
    if (out.has_extension()) return out.filename().string();
    if (is_slurm(command)) return "job.sh";
    return command[1] == "--plan" ? "plan.html" : "report.html";
  }

  bool is_half_written(const std::string& name) const {
    std::error_code error;
    for (fs::recursive_directory_iterator i(path("out"), error), end; !error && i != end; i.increment(error))
      if (i->path().filename().string().starts_with(name + ".part-")) return true;
    return false;
  }

  /// Starts the command, on a disk that takes long to store its late file, and sends the signal then.
  int end_while_writing(const Arguments& command, int signal) const {
    const char* sanitizer = std::getenv("ASAN_OPTIONS");
    Arguments all = {std::string("LD_PRELOAD=") + HALYARD_SLOW_DISK, "SLOW_FILE=" + late_file(command),
                     "ASAN_OPTIONS=" + (sanitizer ? sanitizer + std::string(":") : "") + "verify_asan_link_order=0",
                     program_.string()};
    all.insert(all.end(), command.begin(), command.end());
    BackgroundRun run("/usr/bin/env", folder_, all, err_path());
    EXPECT_TRUE(comes_true([&] { return is_half_written(late_file(command)); }));
    run.send(signal);
    return run.wait();
  }

  void TearDown() override {
    fs::remove(err_path());
    Faults::TearDown();
  }
};

TEST_F(FaultsWhileWriting, ASignalLeavesNoTemporaryFiles) {
  int signal = SIGINT;
  for (const Arguments& command : commands()) {
    signal = signal == SIGINT ? SIGTERM : SIGINT;
    SCOPED_TRACE(line_of(command) + ", signal " + std::to_string(signal));
    Files before = files_in(folder_);
    EXPECT_EQ(end_while_writing(command, signal), 128 + signal);
    expect_line(text_of(err_path()), signal == SIGINT ? "halyard: ended by SIGINT" : "halyard: ended by SIGTERM");
    Files after = files_in(folder_);
    if (command[0] == "sweep") after.erase("out/sweep.json");  // it stands from the start
    const bool has_points = after.erase("out/cells/all.jsonl") > 0;
    EXPECT_EQ(has_points, computes_sweep(command)) << "finished points are kept";
    EXPECT_TRUE(after == before) << "files were left or changed";
    fs::remove_all(path("out"));
  }
}

TEST_F(FaultsWhileWriting, WhatAKilledRunLeavesGoesWithTheNextRun) {
  for (const Arguments& command : commands()) {
    SCOPED_TRACE(line_of(command));
    const Files whole = files_of(command);
    EXPECT_EQ(end_while_writing(command, SIGKILL), 128 + SIGKILL);
    EXPECT_TRUE(is_half_written(late_file(command)));
    const RunResult again = run(command);
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_TRUE(files_in(path("out")) == whole) << "leftovers, or another result";
    fs::remove_all(path("out"));
  }
}

}  // namespace
}  // namespace halyard::testing_program
