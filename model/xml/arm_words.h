#pragma once
/// Words for non-numeric values in model files; the reader and the writer share them.

#include <string>
#include <utility>
#include <vector>

#include "transmission/arm_parameters.h"

namespace halyard {

template <class Choice>
using Words = std::vector<std::pair<std::string, Choice>>;

inline const Words<JointType>& words_of(JointType) {
  static const Words<JointType> words = {{"revolute", JointType::revolute}, {"prismatic", JointType::prismatic}};
  return words;
}

inline const Words<Drive>& words_of(Drive) {
  static const Words<Drive> words = {{"cable", Drive::cable}, {"rigid", Drive::rigid}, {"none", Drive::none}};
  return words;
}

inline const Words<CableLaw>& words_of(CableLaw) {
  static const Words<CableLaw> words = {
      {"paper", CableLaw::paper}, {"exponential", CableLaw::exponential}, {"linear", CableLaw::linear}};
  return words;
}

inline const Words<TorqueSource>& words_of(TorqueSource) {
  static const Words<TorqueSource> words = {{"commanded", TorqueSource::commanded},
                                            {"measured", TorqueSource::measured}};
  return words;
}

template <class Choice>
std::string word_for(Choice choice) {
  for (const auto& [word, meaning] : words_of(choice))
    if (meaning == choice) return word;
  return {};
}

/// Marks a sensor's zero as unknown.
inline constexpr const char* kUnknownZero = "unknown";

}  // namespace halyard
