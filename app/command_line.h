#pragma once

namespace halyard {

/// Parses the arguments and runs the command. Returns 0 after success or after printing help.
/// Throws InputError for wrong usage or input, anything else for other failures.
int run_command_line(int argc, char** argv);

}  // namespace halyard
