// Model files. A model that is read is written and read again, and has to stay the same.
#include "model/model_file.h"
#include "tests/fuzz/reader.h"

using namespace halyard;
using namespace halyard::fuzzing;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string written;
  if (!reads([&] { written = model_to_xml(parse_model(std::string(text_of(data, size)), "arm.xml")); })) return 0;
  try {
    if (model_to_xml(parse_model(written, "written.xml")) != written) finding("the model changes as it is written");
  } catch (const std::exception& error) {
    finding(std::string("a model that was read cannot be read again: ") + error.what());
  }
  return 0;
}
