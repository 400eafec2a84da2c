// Scenario files, beside a model (arm.xml) and a log with trajectories (motion.csv).
#include "plant/scenario.h"
#include "tests/fuzz/reader.h"

using namespace halyard;
using namespace halyard::fuzzing;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  reads_file(data, size, [](const char* file) { read_scenario(file); });
  return 0;
}
