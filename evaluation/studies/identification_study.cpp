#include "evaluation/studies/identification_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/holdout/holdout.h"
#include "evaluation/joint_unit.h"

namespace halyard {
namespace {

constexpr const char* kEstimators[] = {"kinematics", "sr_ukf"};
constexpr double kWorse = 1.1;  // an error that has grown by more has grown
constexpr double kLarge = 3;    // innovations of so many standard deviations are not the filter's noise

std::string names_of(const std::vector<Log>& logs) {
  std::string names;
  for (const Log& log : logs) names += (names.empty() ? "" : ", ") + log.source;
  return names;
}

/// The estimator whose errors on the hold-out decide.
const EstimatorComparison& judge_of(const IdentificationStudy& result) {
  return *std::ranges::find(result.estimators, "sr_ukf", &EstimatorComparison::name);
}

/// RMS error of joint k with the identified numbers over that with the given; 1 where it is not known.
double growth(const EstimatorComparison& e, int k) {
  if (e.before.rms.empty() || e.after.rms.empty()) return 1;
  const double ratio = e.after.rms[k] / e.before.rms[k];
  return std::isfinite(ratio) ? ratio : 1;
}

/// "joint 2 by 2 times, joint 3 by 1.2 times": joints whose error has grown.
std::string worse_joints(const IdentificationStudy& result) {
  std::string text;
  for (int k = 0; k < result.given.n(); ++k)
    if (const double ratio = growth(judge_of(result), k); ratio > kWorse)
      text += fmt::format("{}joint {} by {:.2g} times", text.empty() ? "" : ", ", k + 1, ratio);
  return text;
}

}  // namespace

IdentificationStudy study_identification(const ArmModel& model, const std::vector<Log>& logs,
                                         const std::optional<Log>& holdout, const std::vector<std::string>& keys,
                                         const std::function<void(const std::string&, double)>& progress,
                                         const ContainmentOptions& containment) {
  IdentificationStudy study;
  study.given = model;
  std::vector<Log> training;
  std::vector<HeldOutLog> held_out;
  if (holdout) {
    training = logs;
    held_out.push_back({&*holdout, holdout->time.front()});
    study.holdout = holdout->source;
    study.data = names_of(training);
  } else {
    for (const Log& log : logs) {
      auto [first, last] = split_log(log, kTrainingShare);
      if (last.size() > 0) held_out.push_back({&log, last.time.front()});
      training.push_back(std::move(first));
    }
    study.holdout = "the last third of " + names_of(logs);
    study.data = "the first two thirds of " + names_of(logs);
  }
  study.identification = identify(model, training, keys, progress);
  for (const char* name : kEstimators) {
    if (progress) progress("estimators on the hold-out", 0);
    study.estimators.push_back({name, errors_of(name, model, held_out, containment),
                                errors_of(name, study.identification.model, held_out, containment)});
  }
  return study;
}

bool adopted(const IdentificationStudy& result) {
  const EstimatorComparison& judge = judge_of(result);
  if (judge.before.failure.empty() && !judge.after.failure.empty()) return false;
  double product = 1;
  for (int k = 0; k < result.given.n(); ++k) product *= growth(judge, k);
  return worse_joints(result).empty() || product <= 1;
}

std::vector<std::string> doubts(const IdentificationStudy& result) {
  std::vector<std::string> all;
  constexpr std::size_t kNamed = 4;
  const std::vector<DeviatingNumber>& deviating = result.identification.deviating;
  std::string names;
  for (std::size_t i = 0; i < std::min(kNamed, deviating.size()); ++i)
    names +=
        (i == 0 ? "" : ", ") + fmt::format("{} ({:.3g} instead of {:.3g}{})", deviating[i].name, deviating[i].value,
                                           deviating[i].nominal, unit_suffix(deviating[i].unit));
  if (deviating.size() > kNamed) names += fmt::format(" and {} more", deviating.size() - kNamed);
  if (!names.empty())
    all.push_back(
        "other parameters would move by more than twice their tolerance: " + names +
        "; either the model lacks an effect, which halyard diagnose can find, or the filter's estimate is off "
        "by more than its noise explains (docs/identification.md)");
  if (const std::string& failure = result.identification.filter_failure; !failure.empty())
    all.push_back(fmt::format("the dual filter ended early ({}); the estimate starts at the model's values", failure));
  if (const double size = result.identification.innovation_size; size > kLarge)
    all.push_back(
        fmt::format("the filter's innovations are {:.2g} times what its noise explains, and the estimate is less "
                    "certain by this factor: the model lacks an effect, which halyard diagnose can find, or it "
                    "states too little noise, in <encoders> or in <estimator name=\"sr_ukf\">",
                    size));
  if (!result.identification.converged)
    all.push_back("the estimate still moves after the last pass over the data, and is not where its interval says");
  const EstimatorComparison& judge = judge_of(result);
  std::string worse = worse_joints(result);
  if (!judge.after.failure.empty()) worse = fmt::format("fails: {}", judge.after.failure);
  if (!adopted(result))
    all.push_back(
        fmt::format("{} with the identified numbers is worse on the hold-out ({}), so that model.xml keeps "
                    "the given ones; they may stand for something that the model lacks, which halyard "
                    "diagnose can find; if it finds nothing, these data do not determine them well enough",
                    judge.name, worse));
  else if (!worse.empty())
    all.push_back(fmt::format("{} with the identified numbers is not better at all joints of the hold-out ({})",
                              judge.name, worse));
  return all;
}

}  // namespace halyard
