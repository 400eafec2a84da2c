#pragma once
/// What a trial is about: which effects are hidden, how well the sensors see them, how far off the model is, and which
/// arms are drawn.

#include <string>
#include <vector>

namespace halyard::blind {

enum class Kind {
  clean,         ///< no effect
  effect,        ///< one effect of the library, every one in turn
  two_at_joint,  ///< two effects of the library at one joint
  three,         ///< three effects of the library, anywhere in the arm
  form,          ///< one effect by other equations than the library's, every one in turn
  outside,       ///< one effect for which the library has no name, every one in turn
};
/// Which columns the log has and how good they are; draw/sensors.h has the numbers.
enum class Sensors { good, poor, motors };
/// Arms that are drawn; see draw/arms.h.
enum class Arms { raven2, random, geared, mixed };

struct Situation {
  Kind kind = Kind::clean;
  Sensors sensors = Sensors::good;
  int off = 1;  ///< largest error of the model's parameters, in tolerances; 0: the model is exact
  Arms arms = Arms::mixed;
  bool operator==(const Situation&) const = default;
};

std::string word(Kind kind);
std::string word(Sensors sensors);
std::string word(Arms arms);
/// All words, in the order of the values.
std::vector<std::string> kind_words();
std::vector<std::string> sensor_words();
std::vector<std::string> arm_words();
/// Throw InputError for a word that is none.
Kind kind_of(const std::string& word);
Sensors sensors_of(const std::string& word);
Arms arms_of(const std::string& word);

/// "effect-poor-off1-mixed"
std::string label(const Situation& situation);
/// A number that differs between situations, for the random stream.
unsigned stream_of(const Situation& situation);

/// The situations of rows 1, 2, 3, 4 and 6 of the acceptance table (bench/README.md). Throws InputError for another
/// row.
std::vector<Situation> situations_of_row(int row, Arms arms);

}  // namespace halyard::blind
