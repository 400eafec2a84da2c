#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/joint_unit.h"
#include "evaluation/sweep/measures/sweep_measure.h"

namespace halyard {

inline constexpr double kMostSweepPoints = 1e6;

/// One axis of a grid: parameters that vary together. At a point of the grid they all have the same value, or are
/// multiplied by the same factor.
struct SweepAxis {
  enum class Target { robot, model, both };

  std::vector<std::string> parameters;  ///< keys, see parameters/axis_keys.h
  Target applies_to = Target::both;     ///< the simulated robot, the estimators' model, or both
  bool is_factor = false;               ///< values multiply the model file's value instead of replacing it
  bool is_logarithmic = false;          ///< reports draw the axis on a logarithmic scale
  std::string unit;                     ///< of the values; empty for factors and pure numbers
  std::vector<double> values;

  /// "joint1.cable.stiffness", "joint1.cable.tension and 2 more (factor)"
  std::string label() const;
};

/// An effect whose detection limits are measured.
struct SweepEffect {
  std::string name;                ///< Effect::name()
  std::string parameter;           ///< says how large it is
  std::vector<std::string> units;  ///< [n_joints] of that parameter; empty where a joint cannot have the effect
};

/// Part i of n of a grid: the points p with p mod n = i - 1.
struct Shard {
  std::size_t index = 1, count = 1;

  bool holds(std::size_t point) const { return point % count == index - 1; }
  bool is_whole() const { return count == 1; }
};

/// Definition of a sweep, which measures every estimator, or every effect's detection limit, at every joint for every
/// point of the grid. It contains everything that merging and reporting need, and is stored with the results.
struct SweepGrid {
  std::string name;
  std::string id;                           ///< equal for equal definitions: only results with equal ids can be merged
  std::string file;                         ///< name of the sweep file, without its folder; empty: there is none
  std::string scenario, model;              ///< names of the files, without folders
  std::vector<std::string> effect_modules;  ///< names of the files of --effects, without folders
  double skip_s = 0.5;
  std::vector<SweepAxis> axes;
  bool is_sampled = false;              ///< not all combinations: point p has the p-th value of every axis
  std::vector<std::uint64_t> seeds;     ///< each combination of values is simulated with each; empty: the scenario's
  std::vector<std::string> estimators;  ///< as in the sweep file; none in a sweep of detection limits
  std::vector<SweepEffect> effects;     ///< only in a sweep of detection limits
  std::vector<const SweepMeasure*> measures = {&sweep_measures().front()};  ///< elements of sweep_measures()
  std::vector<JointUnit> units;                                             ///< [n_joints]

  /// Number of combinations of the axes' values.
  std::size_t combinations() const;
  std::size_t n_seeds() const { return seeds.empty() ? 1 : seeds.size(); }
  /// Number of points: each combination with each seed.
  std::size_t size() const { return combinations() * n_seeds(); }

  bool measures_limits() const { return !effects.empty(); }
  /// What a cell has results of: names of the estimators, or of the effects.
  std::vector<std::string> subjects() const;
  std::size_t n_subjects() const { return measures_limits() ? effects.size() : estimators.size(); }
  /// Unit of what the m-th measure shows of the i-th subject at joint k.
  JointUnit shown_unit(std::size_t m, std::size_t i, std::size_t k) const;

  /// Number of columns of all measures; of the first m of them.
  std::size_t n_columns() const { return n_columns(measures.size()); }
  std::size_t n_columns(std::size_t m) const;

  /// Index of a point's value on every axis; the last axis varies fastest, the seed faster still.
  std::vector<std::size_t> places(std::size_t point) const;
  /// The point's value on every axis.
  std::vector<double> values(std::size_t point) const;
  /// Nothing without seeds.
  std::optional<std::uint64_t> seed(std::size_t point) const;
  /// "joint1.cable.stiffness = 720000 N/m, ..., seed 3" for the axes from first_axis on; the seed with the first axis.
  std::string description(std::size_t point, std::size_t first_axis = 0) const;
};

}  // namespace halyard
