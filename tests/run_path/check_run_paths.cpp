// check_run_paths PATH...: looks at every ELF file given, listed in a file @LIST, or below a folder given. Every entry
// of a run path has to start from $ORIGIN, the folder of the file itself: an empty or relative entry is looked up in
// the current folder of whoever runs the program, and an absolute one names a folder of the machine that built it.
#include <cstdio>
#include <exception>

#include "tests/support/elf_file.h"

namespace {

namespace fs = std::filesystem;
using namespace halyard::testing_program;

int checked = 0, faults = 0;

void check(const fs::path& path) {
  if (!is_elf_file(path)) return;
  ++checked;
  for (const std::string& entry : dynamic_section_of(path).run_paths) {
    if (entry == "$ORIGIN" || entry.starts_with("$ORIGIN/")) continue;
    ++faults;
    std::printf("%s: run path has %s\n", path.c_str(),
                entry.empty() ? "an empty entry" : ("the entry " + entry).c_str());
  }
}

void check_all(const std::string& given) {
  if (given.starts_with('@')) {
    std::ifstream list(given.substr(1));
    for (std::string path; std::getline(list, path);) check_all(path);
  } else if (fs::is_directory(given)) {
    for (const auto& entry : fs::recursive_directory_iterator(given))
      if (entry.is_regular_file()) check(entry.path());
  } else {
    check(given);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  for (int i = 1; i < argc; ++i) check_all(argv[i]);
  std::printf("%d files, %d faults\n", checked, faults);
  return checked > 0 && faults == 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
