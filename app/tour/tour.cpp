#include "app/tour/tour.h"

#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>

#include "app/pages/diagnosis/diagnosis_output.h"
#include "model/arm_log.h"
#include "model/machine/first_failure.h"
#include "model/model_file.h"
#include "plant/scenario.h"

namespace halyard {
namespace {

namespace fs = std::filesystem;
using StageCallback = std::function<void(const std::string&, double)>;

/// A part of the tour that is computed beside the others.
struct Part {
  std::string name;
  std::function<void(const StageCallback&)> compute;
};

/// Of parts that run at once, tells of the first one that is not done yet.
class PartsProgress {
 public:
  PartsProgress(const std::vector<Part>& parts, const StageCallback& tell)
      : parts_(parts), tell_(tell), done_(parts.size(), false) {}

  void set(std::size_t part, const std::string& stage, double fraction) {
    const std::lock_guard lock(mutex_);
    if (!tell_ || std::ranges::find(done_, false) - done_.begin() != std::ptrdiff_t(part)) return;
    tell_(fmt::format("{} of {} parts done; {}: {}", std::ranges::count(done_, true), done_.size(), parts_[part].name,
                      stage),
          fraction);
  }
  void set_done(std::size_t part) {
    const std::lock_guard lock(mutex_);
    done_[part] = true;
  }

 private:
  const std::vector<Part>& parts_;
  const StageCallback& tell_;
  std::mutex mutex_;
  std::vector<bool> done_;
};

void compute_all(const std::vector<Part>& parts, const StageCallback& tell) {
  PartsProgress progress(parts, tell);
  FirstFailure failure;
  const tbb::blocked_range<std::size_t> each(0, parts.size(), 1);
  const auto compute = [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      // A thread that waits within a part helps that part: starting another meanwhile would hold both up.
      tbb::this_task_arena::isolate([&] {
        failure.keep(i, [&] {
          parts[i].compute([&](const std::string& stage, double fraction) { progress.set(i, stage, fraction); });
        });
      });
      progress.set_done(i);
    }
  };
  tbb::parallel_for(each, compute, tbb::simple_partitioner());
  failure.rethrow();
}

DiagnosedModel diagnose_rig(const Rig& rig, const fs::path& examples, const fs::path& recordings,
                            const StageCallback& progress) {
  DiagnosedModel result{read_model(examples / "measured" / rig.folder / rig.model), {}, {}};
  const auto read = [&](const std::string& file) {
    return read_log_of(result.model, recordings / rig.folder / file, {}, /*torque_required=*/false);
  };
  std::vector<Log> training;
  for (const std::string& file : rig.training) training.push_back(read(file));
  std::optional<Log> holdout;
  if (!rig.holdout.empty()) holdout = read(rig.holdout);
  DiagnosisOptions options;
  options.most_effects = kMostEffectsOfRig;
  result.diagnosis = diagnose(result.model, training, holdout, options, progress);
  result.evaluation = evaluate_diagnosis(result.model, result.diagnosis, training, holdout, progress);
  if (holdout) result.diagnosis.holdout = rig.holdout;  // the same bytes wherever the recordings are
  return result;
}

}  // namespace

Tour compute_tour(const fs::path& examples, const fs::path& recordings, const StageCallback& progress) {
  const fs::path raven2 = examples / "raven2";
  Tour tour;
  for (const Rig& rig : measured_rigs()) tour.rigs.push_back({rig, std::nullopt});
  tour.undeclared = read_scenario(raven2 / "undeclared_effect.xml").robot.effects;

  std::vector<Part> parts;
  parts.push_back({"experiments", [&](const StageCallback& tell) {
                     tour.experiments = compute_experiments({.raven2 = raven2},
                                                            [&](double done) { tell("simulate and estimate", done); });
                   }});
  parts.push_back({"undeclared_effect", [&](const StageCallback& tell) {
                     auto& [model, diagnosis, evaluation] = tour.bundled;
                     model = read_model(raven2 / "raven2.xml");
                     const std::vector<Log> logs = {read_log_of(model, raven2 / "undeclared_effect.csv", {})};
                     diagnosis = diagnose(model, logs, std::nullopt, {}, tell);
                     evaluation = evaluate_diagnosis(model, diagnosis, logs, std::nullopt, tell);
                   }});
  for (RigResult& result : tour.rigs) {
    if (!is_at_hand(result.rig, recordings)) continue;
    parts.push_back({result.rig.name, [&](const StageCallback& tell) {
                       result.diagnosed = diagnose_rig(result.rig, examples, recordings, tell);
                     }});
  }
  compute_all(parts, progress);
  return tour;
}

std::vector<FoundParameter> found_parameters(const Tour& tour) {
  std::vector<FoundParameter> all;
  for (const PlacedEffect& truth : tour.undeclared) {
    const auto named = std::ranges::find_if(tour.bundled.diagnosis.effects, [&](const NamedEffect& e) {
      return e.effect.effect == truth.effect && e.effect.joint == truth.joint;
    });
    const auto parameters = truth.effect->parameters(tour.bundled.model.nominal, truth.joint);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      FoundParameter row{effect_label(truth), parameters[i].name, parameters[i].unit, truth.p[i], nullptr};
      if (named != tour.bundled.diagnosis.effects.end()) {
        const auto found = std::ranges::find(named->parameters, row.name, &Estimated::name);
        if (found != named->parameters.end()) row.found = &*found;
      }
      all.push_back(std::move(row));
    }
  }
  return all;
}

}  // namespace halyard
