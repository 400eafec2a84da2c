#include "evaluation/sweep/measures/sweep_measure.h"

#include <fmt/format.h>

#include <algorithm>

#include "evaluation/comparison/compare.h"
#include "model/input/cell_text.h"
#include "model/input_error.h"

namespace halyard {
namespace {

template <auto member>
double error_of(const Comparison& c, std::size_t k) {
  return static_cast<double>(c.errors[0][k].*member);
}

template <double Consistency::*member>
double nees_of(const Comparison& c, std::size_t k) {
  return c.judgements[0].nees[k].*member;
}

template <long EstimatorReport::*member>
double count_of(const Comparison& c, std::size_t) {
  return static_cast<double>(c.runs[0].report.*member);
}

SweepMeasure errors_measure() {
  using E = ErrorStatistics;
  return {.name = "errors",
          .columns = {{"samples", error_of<&E::samples>, 0},
                      {"mean_absolute_error", error_of<&E::mean_absolute>},
                      {"rms_error", error_of<&E::rms>},
                      {"peak_error", error_of<&E::peak>},
                      {"bias", error_of<&E::bias>},
                      {"within_two_std", error_of<&E::within_two_std>}},
          .shown = 1,
          .shown_as = "mean absolute error",
          .meaning =
              "the mean absolute error of the joint positions (the paper's Eq. 18) against the truth of the "
              "simulation"};
}

SweepMeasure nees_measure() {
  using C = Consistency;
  return {.name = "nees",
          .columns = {{"mean_nees", nees_of<&C::mean>},
                      {"nees_band_lower", nees_of<&C::lower>},
                      {"nees_band_upper", nees_of<&C::upper>},
                      {"nees_independent_samples", nees_of<&C::samples>}},
          .shown_as = "mean NEES",
          .meaning =
              "the mean of the squared error over the variance that the estimator states (NEES), which is near 1 "
              "if the estimator is consistent, and larger if it is too sure",
          .unit = ""};
}

SweepMeasure counts_measure() {
  using R = EstimatorReport;
  return {.name = "counts",
          .columns = {{"steps", count_of<&R::steps>},
                      {"gated_measurements", count_of<&R::gated>},
                      {"repaired_factors", count_of<&R::repaired_factors>}},
          .shown = 1,
          .shown_as = "gated measurements",
          .meaning = "the number of measurements that the estimator did not accept",
          .unit = "",
          .is_of_joint = false};
}

SweepMeasure time_measure() {
  return {.name = "time",
          .columns = {{"microseconds_per_step",
                       [](const Comparison& c, std::size_t) { return c.runs[0].microseconds_per_step; }}},
          .shown_as = "time per step",
          .meaning = "the wall time of a step",
          .unit = "us",
          .is_of_joint = false,
          .is_repeatable = false};
}

const SweepMeasure& measure_named(std::string_view name) {
  const auto found = std::ranges::find(sweep_measures(), name, &SweepMeasure::name);
  if (found != sweep_measures().end()) return *found;
  std::vector<std::string> names;
  for (const SweepMeasure& measure : sweep_measures()) names.push_back(measure.name);
  throw InputError(fmt::format("{} is no measure; expected one or more of {}, with one comma between them",
                               in_quotes(name), fmt::join(names, ", ")));
}

}  // namespace

const std::vector<SweepMeasure>& sweep_measures() {
  static const std::vector<SweepMeasure> measures = {errors_measure(), nees_measure(), counts_measure(),
                                                     time_measure()};
  return measures;
}

const SweepMeasure& limits_measure() {
  static const SweepMeasure limits = {.name = "limits",
                                      .columns = {{"detection_limit"}, {"naming_limit"}},
                                      .shown_as = "detection limit",
                                      .meaning = "the smallest size of an effect that a diagnosis would see"};
  return limits;
}

std::vector<const SweepMeasure*> parse_measures(std::string_view text) {
  std::vector<std::string_view> names;
  split(text, names);
  std::vector<const SweepMeasure*> measures;
  for (const std::string_view name : names) {
    const SweepMeasure* measure = &measure_named(name);
    if (std::ranges::find(measures, measure) != measures.end())
      throw InputError(in_quotes(name) + " is listed twice; list it once");
    measures.push_back(measure);
  }
  if (std::ranges::none_of(measures, &SweepMeasure::is_repeatable))
    throw InputError("has nothing for sweep.csv, because times differ from run to run; add errors, nees or counts");
  return measures;
}

}  // namespace halyard
