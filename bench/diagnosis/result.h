#pragma once
/// What is kept of a trial: the truth and what the diagnosis said. One JSON file each, complete or absent.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "transmission/effect.h"

namespace halyard::blind {

enum class Kind { clean_exact, clean_mistuned, effect, effect_mistuned, form, outside, pair, each_effect };
inline constexpr int kKinds = 8;
std::string word(Kind kind);
/// Throws InputError for a word that is none.
Kind kind_of(const std::string& word);

struct Place {
  std::string effect;  ///< name
  EffectPlace joint = kWholeArm;
  bool operator==(const Place&) const = default;
};
std::string label(const Place& place);

struct TrueParameter {
  std::string name;
  double value = 0;
  bool acts = true;  ///< false: it may shape a size that is absent, so that its value says nothing
};

struct TrueEffect {
  Place place;          ///< the right answer; of an outside effect its own name, which no answer can be
  std::string form;     ///< the effect that acted, if the right answer is another name
  double size = 0;      ///< the largest of its sizes over the typical one
  double strength = 0;  ///< see strength.h
  std::vector<TrueParameter> parameters;
};

struct Parameter {
  std::string name;
  double value = 0, lower = 0, upper = 0;  ///< 95 % interval
};

struct Named {
  Place place;
  std::vector<Place> alternatives;
  std::vector<Parameter> parameters;
};

struct Result {
  Kind kind = Kind::clean_exact;
  int index = 0;
  std::uint64_t seed = 0;
  double limit = 0;     ///< of the drawing, TrialOptions
  std::string failure;  ///< why there is no diagnosis; empty: there is
  std::vector<TrueEffect> truth;
  std::string verdict;
  std::vector<Named> named;
  std::vector<int> unexplained;  ///< joints from 1 on
  /// Errors of the joint position on the hold-out, per joint: of the given model, of the revised one, of the truth.
  std::vector<double> before, after, true_model;
  double wall_s = 0, cpu_s = 0;  ///< of diagnose(), on one thread
};

/// The truth was named first.
bool right_first(const Result& r);
/// Every effect of the truth was named.
bool all_named(const Result& r);
/// The diagnosis says that something is left: unknown, or effects and an unexplained residual.
bool admits_rest(const Result& r);
/// The truth was named first, or is one of at most two alternatives to what was.
bool right_or_alternative(const Result& r);

/// What the kind of trial asks for: no name, the right name first, both names, or a rest.
bool is_right(const Result& r);

std::filesystem::path result_path(const std::filesystem::path& folder, Kind kind, int index);
void write_result(const std::filesystem::path& folder, const Result& r);
/// Throws InputError for a file that is no result.
Result read_result(const std::filesystem::path& path);

}  // namespace halyard::blind
