#pragma once
/// A locale with decimal commas, made where a test can use it: most machines have none.

#include <cstdlib>
#include <filesystem>
#include <string>

namespace halyard {

inline constexpr const char* kGermanLocale = "de_DE.UTF-8";
inline constexpr const char* kNoGermanLocale = "no localedef here, or no definition of the locale de_DE";

/// Puts the locale into the folder, where LOCPATH finds it. False if this machine cannot make it.
inline bool make_german_locale(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const std::string made = (folder / kGermanLocale).string();
  return std::system(("localedef -i de_DE -f UTF-8 '" + made + "' 2>/dev/null").c_str()) == 0;
}

}  // namespace halyard
