#pragma once

#include <filesystem>
#include <vector>

namespace halyard {

/// Throws InputError if a log occurs twice in --data and --holdout, because it would then count as twice the evidence.
void check_given_once(const std::vector<std::filesystem::path>& logs);

}  // namespace halyard
