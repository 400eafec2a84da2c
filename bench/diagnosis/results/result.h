#pragma once
/// What is kept of a trial: the truth and what the diagnosis said. One JSON file each, complete or absent; a whole draw
/// can be kept as one file with a line for each.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/diagnosis/results/situation.h"

namespace halyard::blind {

/// An effect by its name, at a joint from 1 on, or 0: the arm.
struct Place {
  std::string effect;
  int joint = 0;
  bool operator==(const Place&) const = default;
};
std::string label(const Place& place);

struct TrueParameter {
  std::string name;
  double value = 0;
  bool acts = true;  ///< false: it may shape a size that is absent, so that its value says nothing
};

struct TrueEffect {
  Place place;       ///< the right answer; of an outside effect its own name, which no answer can be
  std::string form;  ///< the effect that acted, if the right answer is another name
  double size = 0;   ///< the largest of its sizes over the typical one
  /// The share of its sizes from which on `--plan` promises that a diagnosis sees it (recording.h). Infinite: not even
  /// all of it.
  double seen_from = 0;
  /// Of a single effect of the library: the share from which on `--plan` promises a name. Infinite: another effect fits
  /// as well, or the plan was not asked.
  double named_from = 0;
  std::vector<TrueParameter> parameters;
  /// True if the plan promises that it is seen, or that it is named.
  bool is_visible() const { return seen_from <= 1; }
  bool is_nameable() const { return named_from <= 1; }
};

struct Parameter {
  std::string name;
  double value = 0, lower = 0, upper = 0;  ///< 95 % interval
};

struct Alternative {
  Place place;
  double probability = 0;
  bool in_set = false;  ///< belongs to the set that contains the truth with 90 %
};

struct Named {
  Place place;
  double probability = 0;
  std::vector<Alternative> alternatives;
  std::vector<Parameter> parameters;
};

/// Errors of the joint position on the hold-out, RMS of each joint: of the given model, the revised one, the truth, and
/// the fit that knows the effects (informed_fit.h; empty if there is none). NaN for a joint without readings.
struct HoldOutErrors {
  std::vector<double> before, after, true_model, informed;
  /// (after² - before²) over its standard deviation, of each joint; see hold_out_errors().
  std::vector<double> rise;
};

struct Result {
  Situation situation;
  int index = 0;
  std::uint64_t seed = 0;
  std::string failure;  ///< why there is no diagnosis; empty: there is
  /// Why earlier draws of this trial could not be recorded; nothing in files of before these were kept.
  std::optional<std::vector<std::string>> dropped;
  std::string arm;  ///< the arm that was drawn
  int joints = 0;
  double latency_s = 0, joint_rate_hz = 0;  ///< of the joint sensors; a rate of 0: none
  double outliers = 0;                      ///< TrialOptions::outliers
  std::string rule;                         ///< TrialOptions::rule
  std::string program;                      ///< this_program() of the diagnosis; empty in files of before it was kept
  std::vector<TrueEffect> truth;
  /// Names that are true beside the truth: of parameters that are off by more than their tolerance, of a part of an
  /// effect (names_beside()), and `delay` where the joint sensors are late.
  std::vector<Place> also_true;
  std::string verdict;
  std::vector<Named> named;
  std::vector<int> unexplained;                               ///< joints from 1 on
  std::optional<double> probability_clean, probability_none;  ///< empty without a diagnosis
  HoldOutErrors holdout;                                      ///< against the joints themselves: sensors without noise
  HoldOutErrors sensed_holdout;  ///< against the same motion as the sensors of the training read it
  /// Share of the samples of `holdout` in the diagnosis' 95 % intervals of the joint position, of each joint
  /// (Diagnosis::joint_interval). NaN for a joint that the training has not read, and thus has no interval; nothing in
  /// files of before these were kept.
  std::optional<std::vector<double>> interval_coverage;
  double wall_s = 0;  ///< of diagnose(), beside the other trials that ran at that time
};

std::filesystem::path result_path(const std::filesystem::path& folder, const Situation& situation, int index);
void write_result(const std::filesystem::path& folder, const Result& r);
/// Throws InputError for a file that is no result.
Result read_result(const std::filesystem::path& path);
/// The same JSON in one line, without a line break.
std::string result_line(const Result& r);
/// Of a file with such lines. Throws InputError if it cannot be read, and for a line that is no result.
std::vector<Result> read_result_lines(const std::filesystem::path& path);

}  // namespace halyard::blind
