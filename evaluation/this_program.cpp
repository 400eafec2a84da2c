#include "evaluation/this_program.h"

#include <fmt/format.h>
#include <link.h>

#include <algorithm>
#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <vector>

#include "halyard/version.h"
#include "transmission/lanes/instruction_set.h"

namespace halyard {
namespace {

struct LoadedObject {
  std::string file;      ///< without its folder; empty: the program
  std::string build_id;  ///< empty: none
};

/// The description of the note NT_GNU_BUILD_ID among the notes of a segment.
std::string build_id_among(std::string_view notes) {
  constexpr std::string_view kOwner("GNU", 4);  // with its zero byte
  const auto padded = [](std::size_t n) { return (n + 3) / 4 * 4; };
  ElfW(Nhdr) head;
  while (notes.size() >= sizeof head) {
    std::memcpy(&head, notes.data(), sizeof head);
    const std::size_t size = sizeof head + padded(head.n_namesz) + padded(head.n_descsz);
    if (size > notes.size()) return "";
    if (head.n_type == NT_GNU_BUILD_ID && notes.substr(sizeof head, head.n_namesz) == kOwner)
      return std::string(notes.substr(sizeof head + padded(head.n_namesz), head.n_descsz));
    notes.remove_prefix(size);
  }
  return "";
}

int add_object(dl_phdr_info* info, std::size_t, void* objects) {
  LoadedObject object{std::filesystem::path(info->dlpi_name).filename().string(), ""};
  for (int i = 0; i < info->dlpi_phnum && object.build_id.empty(); ++i) {
    const ElfW(Phdr)& segment = info->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    const auto* begin = reinterpret_cast<const char*>(info->dlpi_addr + segment.p_vaddr);
    object.build_id = build_id_among({begin, segment.p_memsz});
  }
  static_cast<std::vector<LoadedObject>*>(objects)->push_back(std::move(object));
  return 0;
}

std::string build() {
  std::vector<LoadedObject> objects;
  ::dl_iterate_phdr(add_object, &objects);
  const auto is_library = [](const LoadedObject& o) { return o.file.starts_with("libhalyard_"); };
  const bool are_in_the_program = std::ranges::none_of(objects, is_library);
  std::ranges::sort(objects, {}, &LoadedObject::file);
  std::string ids;
  for (const LoadedObject& o : objects) {
    if (are_in_the_program ? !o.file.empty() : !is_library(o)) continue;
    if (o.build_id.empty()) return "unknown";
    ids += o.build_id;
  }
  const boost::uuids::name_generator_sha1 hash(boost::uuids::ns::oid());
  return boost::uuids::to_string(hash(ids)).substr(0, 8);
}

const char* name_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::generic: return "generic";
    case InstructionSet::avx2: return "avx2";
    case InstructionSet::avx512: return "avx512";
  }
  return "";
}

}  // namespace

const std::string& this_program() {
  static const std::string text =
      fmt::format("halyard {}, build {}, {}", kVersion, build(), name_of(instruction_sets().front()));
  return text;
}

}  // namespace halyard
