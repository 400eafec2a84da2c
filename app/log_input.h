#pragma once

#include <filesystem>
#include <vector>

namespace halyard {

/// Throws InputError if a log is given twice among those of --data and --holdout: it would look like twice the evidence.
void check_given_once(const std::vector<std::filesystem::path>& logs);

}  // namespace halyard
