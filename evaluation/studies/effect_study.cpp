#include "evaluation/studies/effect_study.h"

#include <algorithm>
#include <atomic>
#include <span>
#include <stdexcept>

#include "evaluation/judgement/error_statistics.h"
#include "evaluation/run/contained_run.h"
#include "model/machine/first_failure.h"
#include "plant/simulate.h"

namespace halyard {
namespace {

using Has = StudiedRobot::Has;

bool names(const std::vector<std::string>& all, const std::string& name) {
  return std::ranges::find(all, name) != all.end();
}

std::vector<std::string> switched_on(const StudiedRobot& robot, const std::vector<std::string>& effects) {
  switch (robot.has) {
    case Has::none: return {};
    case Has::one: return {robot.effect};
    case Has::all: return effects;
    case Has::all_but_one: break;
  }
  std::vector<std::string> rest = effects;
  std::erase(rest, robot.effect);
  return rest;
}

/// [estimator][joint]
std::vector<std::vector<double>> errors_of(const Scenario& scenario, const ArmModel& model,
                                           const std::vector<std::string>& estimators, double skip_s) {
  const SimulationResult data = simulate(scenario);
  const std::size_t first = first_counted_sample(data.truth.time, skip_s);
  std::vector<std::vector<double>> errors;
  for (const std::string& name : estimators) {
    const EstimatorRun run = run_contained(name, model, data.measured);
    errors.emplace_back();
    for (int k = 0; k < model.n(); ++k) {
      const std::span<const double> estimate = run.estimates.joint_position[k], truth = data.truth.joint_position[k];
      errors.back().push_back(error_statistics(estimate.subspan(first), truth.subspan(first)).mean_absolute);
    }
  }
  return errors;
}

}  // namespace

std::string StudiedRobot::name() const {
  switch (has) {
    case Has::none: return "none";
    case Has::one: return effect + " alone";
    case Has::all: return "all";
    case Has::all_but_one: break;
  }
  return "all but " + effect;
}

const StudiedRobot& EffectStudy::robot(Has has, const std::string& effect) const {
  const auto found = std::ranges::find_if(robots, [&](const auto& r) { return r.has == has && r.effect == effect; });
  if (found == robots.end()) throw std::invalid_argument("EffectStudy: no such robot: " + effect);
  return *found;
}

std::vector<std::string> effects_of(const std::vector<Scenario>& scenarios, const ArmModel& model) {
  std::vector<std::string> all;
  const auto add = [&](const std::string& name) {
    if (!names(all, name)) all.push_back(name);
  };
  for (const Scenario& s : scenarios) {
    for (const PlacedEffect& e : s.robot.effects) add(e.effect->name());
    for (int k = 0; k < model.n(); ++k)
      if (s.robot.nominal.joint[k].law != model.nominal.joint[k].law) add(kCableLaw);
  }
  return all;
}

Scenario with_effects(Scenario scenario, const ArmModel& model, const std::vector<std::string>& effects) {
  std::erase_if(scenario.robot.effects, [&](const PlacedEffect& e) { return !names(effects, e.effect->name()); });
  if (!names(effects, kCableLaw))
    for (int k = 0; k < model.n(); ++k) scenario.robot.nominal.joint[k].law = model.nominal.joint[k].law;
  return scenario;
}

EffectStudy study_effects(const std::vector<Scenario>& scenarios, const ArmModel& model,
                          const std::vector<std::string>& estimators, double skip_s,
                          const std::function<void(double)>& progress) {
  EffectStudy study{estimators, effects_of(scenarios, model), {}};
  study.robots.push_back({Has::none, "", {}});
  for (const std::string& effect : study.effects) study.robots.push_back({Has::one, effect, {}});
  study.robots.push_back({Has::all, "", {}});
  for (const std::string& effect : study.effects) study.robots.push_back({Has::all_but_one, effect, {}});

  const std::size_t n_runs = study.robots.size() * scenarios.size();
  std::vector<std::vector<std::vector<double>>> errors(n_runs);
  std::atomic<std::size_t> done = 0;
  for_each_in_parallel(n_runs, [&](std::size_t i) {
    const StudiedRobot& robot = study.robots[i / scenarios.size()];
    const Scenario& scenario = scenarios[i % scenarios.size()];
    errors[i] = errors_of(with_effects(scenario, model, switched_on(robot, study.effects)), model, estimators, skip_s);
    if (progress) progress(double(++done) / double(n_runs));
  });
  for (std::size_t i = 0; i < n_runs; ++i) {
    std::vector<std::vector<double>>& mean = study.robots[i / scenarios.size()].error;
    mean.resize(estimators.size(), std::vector<double>(model.n(), 0));
    for (std::size_t e = 0; e < estimators.size(); ++e)
      for (int k = 0; k < model.n(); ++k) mean[e][k] += errors[i][e][k] / double(scenarios.size());
  }
  return study;
}

}  // namespace halyard
