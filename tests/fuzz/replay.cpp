// The main program of a fuzzer in the ordinary build: gives it every file of the folders in its arguments. A finding,
// or an input that takes longer than five seconds, ends the program with an error.
#include <chrono>
#include <iterator>
#include <vector>

#include "tests/fuzz/reader.h"

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  std::vector<fs::path> files;
  for (int i = 1; i < argc; ++i)
    for (const auto& entry : fs::recursive_directory_iterator(fs::absolute(argv[i])))
      if (entry.is_regular_file()) files.push_back(entry.path());
  if (files.empty()) halyard::fuzzing::finding("no input in the given folders");
  std::ranges::sort(files);
  for (const fs::path& path : files) {
    std::printf("%s\n", path.c_str());
    std::fflush(stdout);
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    const auto start = std::chrono::steady_clock::now();
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    if (std::chrono::steady_clock::now() - start > std::chrono::seconds(5)) halyard::fuzzing::finding("more than 5 s");
  }
}
