#pragma once
/// The frame of the studies here: command line, and exit codes as halyard's: 0 done; 2 wrong usage or invalid input; 1
/// anything else. A failure is one line on stderr.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "model/input_error.h"

namespace halyard {

/// Exit code of run(), which is called once the command line is read.
template <class Run>
int run_program(CLI::App& app, int argc, char** argv, const Run& run) {
  try {
    app.parse(argc, argv);
    return run();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

}  // namespace halyard
