// What a sweep left in its folder: the first line of the input is sweep.json, the rest is a journal of cells.
#include "evaluation/sweep/sweep_cells.h"
#include "evaluation/sweep/sweep_store.h"
#include "tests/fuzz/reader.h"

using namespace halyard;
using namespace halyard::fuzzing;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const WorkFolder folder;
  std::string_view text = text_of(data, size);
  std::filesystem::create_directories("sweep/cells");
  folder.write("sweep/sweep.json", take_line(text));
  folder.write("sweep/cells/all.jsonl", text);
  reads([] {
    const SweepGrid grid = read_grid("sweep");
    const StoredCells cells({"sweep"}, grid);
    for (std::size_t point = 0; point < std::min<std::size_t>(cells.size(), 100); ++point) {
      grid.description(point);
      if (cells.has(point)) cells.read(point);
    }
  });
  return 0;
}
