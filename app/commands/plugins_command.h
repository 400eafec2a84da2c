#pragma once

namespace halyard {

/// halyard plugins: lists the estimators that are found, and the modules that are refused, with the reason.
void run_plugins();

}  // namespace halyard
