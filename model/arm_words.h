#pragma once
/// The words that model files use for what is no number; reader and writer share them.

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

template <class Choice>
std::string word_for(Choice choice) {
  for (const auto& [word, meaning] : words_of(choice))
    if (meaning == choice) return word;
  return {};
}

/// A sensor's zero that a model does not know.
inline constexpr const char* kUnknownZero = "unknown";

}  // namespace halyard
