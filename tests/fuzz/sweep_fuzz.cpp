// Sweep files, beside a scenario (scenario.xml) and a model (arm.xml).
#include "evaluation/sweep/sweep_file.h"
#include "tests/fuzz/reader.h"

using namespace halyard;
using namespace halyard::fuzzing;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  reads_file(data, size, [](const char* file) { read_sweep(file); });
  return 0;
}
