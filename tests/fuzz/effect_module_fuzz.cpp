// Tables of effects: a module whose table and effects come from the input. Effects that are accepted stay in the
// library of the process; their names have at most two letters, so that they cannot become many.
#include <dlfcn.h>

#include "plugins/host/effect_module.h"
#include "tests/fuzz/reader.h"

using namespace halyard;
using namespace halyard::fuzzing;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using TakeInput = void (*)(const std::uint8_t*, std::size_t);
  static const auto take_input =
      reinterpret_cast<TakeInput>(dlsym(dlopen(HALYARD_FUZZ_EFFECTS, RTLD_NOW), "take_input"));
  take_input(data, size);
  reads([] { load_effects(HALYARD_FUZZ_EFFECTS); });
  return 0;
}
