#include "app/bundled_files.h"

#include "model/input_error.h"
#include "plugins/host/program_location.h"

namespace halyard {

namespace fs = std::filesystem;

fs::path examples_folder(const fs::path& given, const std::string& command) {
  std::error_code error;
  const auto holds_examples = [&](const fs::path& folder) {
    return fs::exists(folder / "raven2" / "raven2.xml", error);
  };
  if (!given.empty()) {
    if (holds_examples(given)) return given;
    throw InputError("halyard " + command + ": --examples " + in_quotes(given.string()) +
                     ": has no raven2/raven2.xml; give the folder that holds the folder raven2");
  }
  for (const fs::path& folder :
       {program_folder() / HALYARD_EXAMPLES_FROM_PROGRAM, fs::path(HALYARD_EXAMPLES_IN_SOURCE)}) {
    if (holds_examples(folder)) return folder;
  }
  throw InputError("halyard " + command +
                   ": the examples of this program are not found; give their folder with --examples DIR");
}

fs::path default_recordings_folder() {
  return (fs::path(HALYARD_EXAMPLES_IN_SOURCE) / "../../shared/data").lexically_normal();
}

}  // namespace halyard
