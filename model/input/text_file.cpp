#include "model/input/text_file.h"

#include <algorithm>
#include <cstdint>
#include <fstream>

#include "model/input_error.h"
#include "model/machine/memory_limit.h"
#include "model/output/read_files.h"

namespace halyard {
namespace {

/// The text, its copy as it grows, what is read from it, and what `compare` keeps of a run: measured on logs of 11 and
/// 22 MB. Other commands need less.
constexpr double kBytesInMemory = 11;
constexpr std::uintmax_t kFirstBlock = 1 << 16;  // bytes

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw InputError(path.string() + ": " + why);
}

/// Block by block: read() tells an error of the disk from the end of the file, which operator<< does not. Each block
/// is as large as all before it, so that a file without an end, such as a pipe, meets the limit of the memory, too.
std::string read_to_end(std::ifstream& file, std::uintmax_t first_block, const std::filesystem::path& path,
                        const TextFileKind& kind) {
  std::string text;
  for (std::uintmax_t block = first_block; file; block = std::max<std::uintmax_t>(text.size(), kFirstBlock)) {
    check_memory(kBytesInMemory * static_cast<double>(text.size() + block), path.string(), kind.if_too_large);
    const std::size_t before = text.size();
    text.resize(before + block);
    file.read(text.data() + before, static_cast<std::streamsize>(block));
    text.resize(before + static_cast<std::size_t>(file.gcount()));
  }
  return text;
}

}  // namespace

std::string read_text_file(const std::filesystem::path& path, const TextFileKind& kind) {
  const std::string remedy = std::string("; give the path of ") + kind.name;
  std::error_code unknown;
  const auto status = std::filesystem::status(path, unknown);
  if (!std::filesystem::exists(status)) refuse(path, "no such file" + remedy);
  if (std::filesystem::is_directory(status)) refuse(path, "is a directory" + remedy);
  // The size of a pipe is unknown, and that of a file of /proc is 0.
  const std::uintmax_t stated = std::filesystem::file_size(path, unknown), size = unknown ? 0 : stated;
  std::ifstream file(path, std::ios::binary);
  std::string text = read_to_end(file, size > 0 ? size + 1 : kFirstBlock, path, kind);  // 1 more: meets the end
  if (!file.is_open() || file.bad() || text.size() < size)
    refuse(path, "cannot be read; check its permissions and its disk");
  if (kind.is_input) note_read(path);
  return text;
}

}  // namespace halyard
