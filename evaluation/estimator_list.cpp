#include "evaluation/estimator_list.h"

#include <algorithm>

#include "model/input/cell_text.h"
#include "model/input_error.h"

namespace halyard {

std::vector<std::string> split_estimators(std::string_view text) {
  std::vector<std::string_view> parts;
  split(text, parts);
  std::vector<std::string> names;
  for (const std::string_view part : parts) {
    if (part.empty()) {
      throw InputError("estimators " + in_quotes(text) + ": an empty name; expected names with one comma between them");
    }
    if (std::ranges::find(names, part) != names.end()) {
      throw InputError("estimators " + in_quotes(text) + ": " + in_quotes(part) + " is listed twice; list it once");
    }
    names.emplace_back(part);
  }
  return names;
}

}  // namespace halyard
