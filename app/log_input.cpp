#include "app/log_input.h"

#include "model/input_error.h"

namespace halyard {

void check_given_once(const std::vector<std::filesystem::path>& logs) {
  for (std::size_t i = 0; i < logs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      std::error_code error;
      if (std::filesystem::equivalent(logs[i], logs[j], error) && !error)
        throw InputError(logs[i].string() + ": is given twice among --data and --holdout; give each log once");
    }
}

}  // namespace halyard
