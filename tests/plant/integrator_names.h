#pragma once
/// Every integrator with its name, for the messages of tests.

#include <map>
#include <string>

#include "plant/xml/scenario_words.h"

namespace halyard {

inline const std::map<IntegratorKind, std::string>& integrator_names() {
  static const std::map<IntegratorKind, std::string> all = [] {
    std::map<IntegratorKind, std::string> names;
    for (const auto& [name, kind] : words_of(IntegratorKind())) names[kind] = name;
    return names;
  }();
  return all;
}

}  // namespace halyard
