#include "bench/diagnosis/trial/trial.h"

#include <fmt/core.h>

#include <chrono>
#include <optional>

#include "bench/diagnosis/trial/recording.h"
#include "bench/diagnosis/trial/redraw.h"
#include "bench/diagnosis/trial/take_over.h"
#include "evaluation/this_program.h"
#include "model/model_file.h"
#include "model/output/output_files.h"

namespace halyard::blind {
namespace {

/// What is hidden, in the words of a result.
void describe(const Recording& recording, Result& r) {
  r.arm = recording.model.name;
  r.joints = recording.model.n();
  r.latency_s = recording.sensors.latency_s;
  if (recording.sensors.sees_joints)
    r.joint_rate_hz = recording.sensors.interval_s > 0 ? 1 / recording.sensors.interval_s : 1000;
  for (std::size_t i = 0; i < recording.hidden.size(); ++i) {
    const Hidden& h = recording.hidden[i];
    const std::string acts = h.acts.effect->name();
    Place place = place_of(h.acts, r.joints);
    place.effect = h.right_name;
    r.truth.push_back({.place = place,
                       .form = acts == h.right_name ? "" : acts,
                       .size = relative_size(h.acts, recording.model),
                       .seen_from = recording.seen_from[i],
                       .named_from = recording.named_from,
                       .parameters = true_parameters(h.acts, recording.model)});
  }
  r.also_true = names_beyond_tolerance(recording.model, recording.robot);
  for (std::size_t i = 0; i < recording.hidden.size(); ++i)
    for (const std::string& part : names_beside(recording.hidden[i]))
      r.also_true.push_back({part, r.truth[i].place.joint});
  if (r.latency_s > 0)
    for (int joint = 0; joint <= r.joints; ++joint) r.also_true.push_back({"delay", joint});
}

void write_logs(const std::filesystem::path& folder, const Recording& recording) {
  std::filesystem::create_directories(folder);
  write_file_whole(folder / "model.xml", model_to_xml(recording.model));
  write_file_whole(folder / "truth.xml", model_to_xml(recording.robot));
  write_log(folder / "train.csv", recording.training);
  write_log(folder / "holdout.csv", recording.holdout);
  write_log(folder / "holdout_as_sensed.csv", recording.sensed_holdout);
}

}  // namespace

Result run_trial(const ArmModel& raven2, const Situation& situation, int index, const TrialOptions& options) {
  Random random(options.seed, stream_of(situation), static_cast<std::uint32_t>(index));
  Result r;
  r.situation = situation;
  r.index = index;
  r.seed = options.seed;
  r.outliers = options.outliers;
  r.rule = options.rule;
  r.program = this_program();
  r.dropped.emplace();
  const std::optional<Recording> recording =
      first_possible([&] { return draw_recording(raven2, situation, index, options, random); }, *r.dropped);
  if (!recording) {
    r.failure = r.dropped->back();
    return r;
  }
  describe(*recording, r);
  if (!options.logs.empty()) write_logs(options.logs / fmt::format("{}-{:06}", label(situation), index), *recording);

  const auto wall = std::chrono::steady_clock::now();
  Diagnosis d;
  try {
    DiagnosisOptions how;
    how.tell_not_excited = false;  // is not asked for, and would take as long as a clean log's whole diagnosis
    d = diagnose(recording->model, {recording->training}, recording->holdout, how);
  } catch (const std::exception& error) {
    r.failure = std::string("diagnose: ") + error.what();
    return r;
  }
  r.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  take_over(d, *recording, r);
  return r;
}

}  // namespace halyard::blind
