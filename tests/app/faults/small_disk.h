#pragma once
/// A disk that fills up.

#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <string>

namespace halyard::testing_program {

inline constexpr std::size_t kPage = 4096;  ///< bytes; what a tmpfs gives to files

/// Pages that these files take, by name and content.
inline std::size_t pages_of(const std::map<std::string, std::string>& files) {
  std::size_t pages = 0;
  for (const auto& [name, text] : files) pages += (text.size() + kPage - 1) / kPage;
  return pages;
}

/// A tmpfs in a folder, seen only by this process and those that it starts. Only root may mount one.
class SmallDisk {
 public:
  SmallDisk(const std::filesystem::path& folder, std::size_t pages) : folder_(folder) {
    std::filesystem::create_directories(folder);
    is_mounted_ = has_own_mounts() && ::mount("none", folder.c_str(), "tmpfs", 0, size(pages).c_str()) == 0;
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    if (is_mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
  }

  bool is_mounted() const { return is_mounted_; }
  bool resize(std::size_t pages) const {
    return ::mount("none", folder_.c_str(), "tmpfs", MS_REMOUNT, size(pages).c_str()) == 0;
  }

 private:
  static bool has_own_mounts() {
    static const bool own =
        ::unshare(CLONE_NEWNS) == 0 && ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
    return own;
  }
  static std::string size(std::size_t pages) { return "size=" + std::to_string(pages * kPage); }

  std::filesystem::path folder_;
  bool is_mounted_ = false;
};

}  // namespace halyard::testing_program
