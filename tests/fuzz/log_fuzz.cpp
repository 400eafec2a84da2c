// Logs with a column map: the first line of the input holds entries of --column, with blanks between them, and the rest
// is the CSV file. A log that is read is also checked against its model (arm.xml), as every command does.
#include <iterator>
#include <sstream>

#include "diagnosis/log_check/log_check.h"
#include "model/arm_log.h"
#include "model/model_file.h"
#include "tests/fuzz/reader.h"

using namespace halyard;
using namespace halyard::fuzzing;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const WorkFolder folder;
  static const ArmModel model = read_model("arm.xml");
  std::string_view text = text_of(data, size);
  std::istringstream entries{std::string(take_line(text))};
  const std::vector<std::string> columns{std::istream_iterator<std::string>(entries), {}};
  folder.write("input.csv", text);
  reads([&] {
    const Log log = read_log_of(model, "input.csv", columns);
    check_message(ignored_columns_note(log));
    for (const LogFinding& found : check_log(log, model, columns_of(model, columns)))
      check_message(finding_line(found));
    line_of_sample(log, log.size() - 1);
  });
  return 0;
}
