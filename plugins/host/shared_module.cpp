#include "plugins/host/shared_module.h"

#include <dlfcn.h>
#include <elf.h>
#include <link.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <mutex>
#include <set>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

#include "model/input_error.h"

namespace halyard {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw InputError("plugin " + path.string() + ": " + why);
}

/// The loader of the C library maps a file that was cut short without a word and the process dies at the first access
/// beyond its end, so this looks before.
void check_elf_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) refuse(path, "no such file; check the path");
  if (!std::filesystem::is_regular_file(status)) refuse(path, "not a file; give the path of a module (.so)");
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path, "cannot be read; check its permissions");

  constexpr const char* kNoModule = "not a shared module (ELF); give the path of a compiled plug-in (.so)";
  ElfW(Ehdr) header;
  if (!file.read(reinterpret_cast<char*>(&header), sizeof header)) refuse(path, kNoModule);
  if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) refuse(path, kNoModule);
  constexpr unsigned char kOwnClass = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
  if (header.e_ident[EI_CLASS] != kOwnClass || header.e_type != ET_DYN) return;  // the loader has words for these

  const auto size = std::filesystem::file_size(path);
  for (unsigned i = 0; i < header.e_phnum; ++i) {
    ElfW(Phdr) segment;
    file.seekg(static_cast<std::streamoff>(header.e_phoff + i * sizeof segment));
    if (!file.read(reinterpret_cast<char*>(&segment), sizeof segment) ||
        (segment.p_type == PT_LOAD && segment.p_offset + segment.p_filesz > size))
      refuse(path, "the file is cut short; build or copy it again");
  }
}

/// What decides how this thread rounds and what it does with tiny numbers; without the sticky exception flags.
class FloatingPointMode {
 public:
#if defined(__x86_64__)
  static unsigned current() { return _mm_getcsr() & ~static_cast<unsigned>(_MM_EXCEPT_MASK); }
  static void set(unsigned mode) { _mm_setcsr(mode); }
#else
  static unsigned current() { return 0; }
  static void set(unsigned) {}
#endif
};

/// One module at a time is loaded or unloaded: the next one may come to the addresses of the last.
std::mutex& loading() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

SharedModule::SharedModule(const std::filesystem::path& path) : path_(path) {
  check_elf_file(path);
  // The mode is changed once, in the thread that comes first: a second load of a module that the C library keeps would
  // pass unseen, so what was refused stays refused.
  static std::set<std::filesystem::path> mode_changers;
  const std::lock_guard lock(loading());
  const std::filesystem::path file = std::filesystem::canonical(path);

  const unsigned mode = FloatingPointMode::current();
  handle_ = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle_) {
    std::string why = dlerror();
    const std::string prefix = file.string() + ": ";
    if (why.starts_with(prefix)) why.erase(0, prefix.size());
    refuse(path, "cannot be loaded: " + one_line(why) + "; rebuild it, or install what it needs");
  }
  if (FloatingPointMode::current() != mode) mode_changers.insert(file);
  if (mode_changers.contains(file)) {
    dlclose(handle_);
    FloatingPointMode::set(mode);
    refuse(path, "changes the floating-point mode of the whole process when loaded; link it without -ffast-math");
  }
}

SharedModule::~SharedModule() {
  const std::lock_guard lock(loading());
  dlclose(handle_);
}

void* SharedModule::symbol(const char* name) const { return dlsym(handle_, name); }

std::string one_line(std::string text) {
  constexpr std::size_t kMaxLength = 500;
  if (text.size() > kMaxLength) text.resize(kMaxLength);
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace halyard
