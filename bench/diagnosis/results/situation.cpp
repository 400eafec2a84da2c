#include "bench/diagnosis/results/situation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "model/input_error.h"

namespace halyard::blind {
namespace {

const std::vector<std::string> kKindWords = {"clean", "effect", "two_at_joint", "three", "form", "outside"};
const std::vector<std::string> kSensorWords = {"good", "poor", "motors"};
const std::vector<std::string> kArmWords = {"raven2", "random", "geared", "mixed"};

int place_in(const std::vector<std::string>& words, const std::string& option, const std::string& text) {
  const auto found = std::ranges::find(words, text);
  if (found == words.end())
    throw InputError(fmt::format("{}: {}: expected one of {}", option, in_quotes(text), fmt::join(words, ", ")));
  return static_cast<int>(found - words.begin());
}

}  // namespace

std::string word(Kind kind) { return kKindWords[static_cast<std::size_t>(kind)]; }
std::string word(Sensors sensors) { return kSensorWords[static_cast<std::size_t>(sensors)]; }
std::string word(Arms arms) { return kArmWords[static_cast<std::size_t>(arms)]; }
std::vector<std::string> kind_words() { return kKindWords; }
std::vector<std::string> sensor_words() { return kSensorWords; }
std::vector<std::string> arm_words() { return kArmWords; }
Kind kind_of(const std::string& text) { return static_cast<Kind>(place_in(kKindWords, "--kind", text)); }
Sensors sensors_of(const std::string& text) { return static_cast<Sensors>(place_in(kSensorWords, "--sensors", text)); }
Arms arms_of(const std::string& text) { return static_cast<Arms>(place_in(kArmWords, "--arms", text)); }

std::string label(const Situation& s) {
  return fmt::format("{}-{}-off{}-{}", word(s.kind), word(s.sensors), s.off, word(s.arms));
}

unsigned stream_of(const Situation& s) {
  return static_cast<unsigned>(s.kind) + 16 * static_cast<unsigned>(s.sensors) + 256 * static_cast<unsigned>(s.off) +
         4096 * static_cast<unsigned>(s.arms);
}

std::vector<Situation> situations_of_row(int row, Arms arms) {
  using enum Kind;
  using enum Sensors;
  std::vector<Situation> all;
  const auto add = [&](std::vector<Kind> kinds, std::vector<Sensors> sensors, int off) {
    for (const Kind k : kinds)
      for (const Sensors s : sensors) all.push_back({k, s, off, arms});
  };
  switch (row) {
    case 1: add({clean}, {poor}, 1); break;
    case 2: add({effect}, {good, poor, motors}, 1); break;
    case 3: add({two_at_joint, three}, {good, poor}, 1); break;
    case 4: add({form, outside}, {good, poor}, 1); break;
    case 6:
      add({effect}, {good, poor, motors}, 2);
      add({two_at_joint, three}, {good, poor}, 2);
      break;
    default:
      throw InputError(fmt::format(
          "--row: {}: expected 1, 2, 3, 4 or 6; --summary counts rows 5 and 7 over the trials of these rows", row));
  }
  return all;
}

}  // namespace halyard::blind
