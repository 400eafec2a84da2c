#include "evaluation/run/tried_effects.h"

#include "evaluation/worker/worker_process.h"
#include "model/input_error.h"
#include "plugins/host/effect_module.h"

namespace halyard {
namespace {

void load_in_worker(const std::filesystem::path& path, double limit_s) {
  WorkerTask task;
  task.job = WorkerJob::load;
  for (const auto& loaded : loaded_effect_modules()) task.effect_modules.push_back(loaded.string());
  task.effect_modules.push_back(path.string());
  WorkerWatch watch;
  watch.step_limit_s = limit_s;
  watch.place = [&](long, const std::string&) { return "plugin " + path.string() + ": as it is loaded"; };
  try {
    result_of_worker(task, watch);
  } catch (const WorkerEnded& end) {
    throw InputError(end.what() +
                     std::string("; correct what runs then: static constructors, halyard_effects(), and the effects' "
                                 "constructors and descriptions"));
  }
}

}  // namespace

void load_tried_effects(const std::filesystem::path& path, const ContainmentOptions& containment) {
  if (!containment.in_process) load_in_worker(path, containment.step_limit_s);
  load_effects(path);
}

}  // namespace halyard
