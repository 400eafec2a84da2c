#pragma once
/// What the dynamic section of a program or shared library (ELF) tells the loader.

#include <elf.h>
#include <link.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace halyard::testing_program {

struct DynamicSection {
  std::vector<std::string> needed;     ///< names of the libraries that are loaded first
  std::vector<std::string> run_paths;  ///< the entries of DT_RUNPATH and DT_RPATH, empty ones too
};

/// The texts between the colons of a run path: "a:" has an empty second entry, which the loader takes for the current
/// folder.
inline std::vector<std::string> entries_of(const std::string& run_path) {
  std::vector<std::string> entries;
  std::istringstream stream(run_path + ":");
  for (std::string entry; std::getline(stream, entry, ':');) entries.push_back(entry);
  return entries;
}

/// Whether the file is an ELF file of this machine's word size.
inline bool is_elf_file(const std::filesystem::path& path) {
  char ident[EI_NIDENT] = "";
  std::ifstream(path, std::ios::binary).read(ident, sizeof ident);
  return std::memcmp(ident, ELFMAG, SELFMAG) == 0 && ident[EI_CLASS] == (sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32);
}

/// Empty for a file without a dynamic section (a static program, an object). Throws std::out_of_range for a file that
/// is cut short, std::invalid_argument for one that is no ELF file.
inline DynamicSection dynamic_section_of(const std::filesystem::path& path) {
  if (!is_elf_file(path)) throw std::invalid_argument(path.string() + " is no ELF file");
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const auto read = [&](auto& to, std::size_t at) {
    if (at + sizeof to > bytes.size()) throw std::out_of_range(path.string() + " is cut short");
    std::memcpy(&to, bytes.data() + at, sizeof to);
  };
  DynamicSection found;
  ElfW(Ehdr) header;
  read(header, 0);
  for (unsigned i = 0; i < header.e_shnum; ++i) {
    ElfW(Shdr) section, names;
    read(section, header.e_shoff + i * sizeof section);
    if (section.sh_type != SHT_DYNAMIC) continue;
    read(names, header.e_shoff + section.sh_link * sizeof names);
    for (std::size_t at = 0; at < section.sh_size; at += sizeof(ElfW(Dyn))) {
      ElfW(Dyn) entry;
      read(entry, section.sh_offset + at);
      const bool is_run_path = entry.d_tag == DT_RUNPATH || entry.d_tag == DT_RPATH;
      if (!is_run_path && entry.d_tag != DT_NEEDED) continue;
      const std::string text = bytes.c_str() + names.sh_offset + entry.d_un.d_val;
      if (!is_run_path) {
        found.needed.push_back(text);
        continue;
      }
      for (const std::string& part : entries_of(text)) found.run_paths.push_back(part);
    }
  }
  return found;
}

}  // namespace halyard::testing_program
