#include "bench/diagnosis/trial.h"

#include <fmt/core.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "bench/diagnosis/draw.h"
#include "bench/diagnosis/motion.h"
#include "bench/diagnosis/strength.h"
#include "diagnosis/diagnosis_details.h"
#include "plant/simulate.h"

namespace halyard::blind {
namespace {

constexpr double kFadeIn = 2, kTraining = 15, kHoldOut = 6;  // s

/// What the diagnosis is given, and what it is not.
struct Recording {
  Log training;
  std::optional<Log> holdout;
  ArmModel robot;  ///< the truth
  std::vector<Hidden> hidden;
};

bool is_clean(Kind kind) { return kind == Kind::clean_exact || kind == Kind::clean_mistuned; }
bool is_mistuned(Kind kind) { return kind == Kind::clean_mistuned || kind == Kind::effect_mistuned; }
/// Whether detection limits are asked for, so that weak effects are drawn too.
bool draws_weak(Kind kind) { return kind == Kind::effect || kind == Kind::effect_mistuned; }

/// The controllers of all runs of a trial.
void scatter_gains(ArmModel& robot, Random& random) {
  for (JointDescription& j : robot.joints) {
    // Above the model's own, so that the motion is followed.
    j.controller.kp *= 2.5 * random.log_uniform(0.7, 1.4);
    j.controller.kd *= 2 * random.log_uniform(0.7, 1.4);
  }
}

Scenario random_run(const ArmModel& robot, const ArmModel& model, double length_s, Random& random) {
  Scenario s;
  s.robot = robot;
  s.assumed = model.nominal;
  s.name = "blind trial";
  s.duration_s = kFadeIn + length_s;
  s.fade_in_s = kFadeIn;
  s.trajectory = random_motion(model, random);
  s.noise.motor_torque.assign(robot.n(), random.uniform(0, 0.2e-3));
  s.seed = random.seed();
  return s;
}

/// The log of a run without its fading in. Throws std::runtime_error if the controller lost the arm.
Log record(const Scenario& scenario) {
  const SimulationResult run = simulate(scenario);
  for (int k = 0; k < scenario.robot.n(); ++k) {
    const JointDescription& j = scenario.robot.joints[k];
    const double beyond = 0.2 * (j.upper - j.lower);
    for (const double q : run.truth.joint_position[k])
      if (!(q > j.lower - beyond && q < j.upper + beyond))
        throw std::runtime_error("joint " + std::to_string(k + 1) + " left its range: the controller lost the arm");
  }
  const auto first = static_cast<std::size_t>(std::lround(kFadeIn / scenario.control_period_s));
  return slice(run.measured, first, run.measured.size());
}

/// What diagnose() learns from.
Log training_part(const Log& log, bool holds_out_itself) {
  return holds_out_itself ? split_log(log, 2.0 / 3).first : log;
}

/// Sizes and shapes of the effect, as strong as the kind of trial asks for; false if it cannot be made so.
bool draw_strength(PlacedEffect& effect, const ArmModel& model, Kind kind, const Ranges& ranges,
                   const StrengthMeter& meter, double limit, Random& random) {
  constexpr int kDraws = 10;
  // The probe is of the arm without the effect: some reserve.
  const double goal = draws_weak(kind) ? 1 : 1.3 * limit;
  for (int draw = 0; draw < kDraws; ++draw) {
    draw_parameters(effect, model, ranges, random);
    double strength = meter.strength(effect);
    while (!draws_weak(kind) && strength < goal && enlarge(effect, model, 1.5)) strength = meter.strength(effect);
    if (std::isfinite(strength) && strength >= goal) return true;
  }
  return false;
}

Recording draw_recording(const ArmModel& model, Kind kind, int index, double limit, Random& random) {
  Recording r;
  r.robot = model;
  scatter_gains(r.robot, random);
  if (is_mistuned(kind)) mistune(r.robot, random);

  const int effects = is_clean(kind) ? 0 : kind == Kind::pair ? 2 : 1;
  for (int i = 0; i < effects; ++i) r.hidden.push_back(draw_effect(model, kind, index, r.hidden, random));
  // A delay acts on what comes before it.
  std::ranges::stable_partition(r.hidden, [](const Hidden& h) { return h.right_name == "delay"; });
  const bool one_log =
      std::ranges::any_of(r.hidden, [&](const Hidden& h) { return happens_at_an_instant(h.acts, model); });

  Scenario training = random_run(r.robot, model, one_log ? kTraining + kHoldOut : kTraining, random);
  Scenario holdout = random_run(r.robot, model, kHoldOut, random);
  holdout.noise = training.noise;
  if (effects > 0) {
    const Log probe = training_part(record(training), one_log);
    const StrengthMeter meter(probe, model);
    Ranges ranges{{probe.time.front(), probe.time.back()}, {}};
    for (const JointTrajectory& t : training.trajectory) {
      const auto [from, to] = reach_of(t, kFadeIn, probe.time.front(), probe.time.back());
      ranges.joint.push_back({from, to});
    }
    for (Hidden& h : r.hidden) {
      if (!draw_strength(h.acts, model, kind, ranges, meter, limit, random))
        throw std::runtime_error(h.acts.effect->name() + " cannot be made strong enough in this motion");
      r.robot.effects.push_back(h.acts);
    }
  }
  training.robot = holdout.robot = r.robot;
  r.training = record(training);
  r.training.source = "training";
  if (!one_log) {
    r.holdout = record(holdout);
    r.holdout->source = "hold-out";
  }
  return r;
}

/// Root mean square of the joints' errors by a model that is given, over the diagnosis' own hold-out.
std::vector<double> joint_errors(const Diagnosis& d, const ArmModel& model) {
  std::vector<double> square(model.n(), 0), count(model.n(), 0);
  for (const Record& record : d.details->joint_view.records) {
    const FullPrediction p = predict_fully(record, {model.nominal, model.effects});
    for (int k = 0; k < model.n(); ++k)
      for (std::size_t i = 0; record.has_joint(k) && i < record.size; ++i) {
        const double e = record.joint_raw[k][i] - p.joint_reading[k][i];
        if (record.joint_valid[k][i] > 0 && !std::isnan(e)) square[k] += e * e, count[k] += 1;
      }
  }
  for (int k = 0; k < model.n(); ++k) square[k] = std::sqrt(square[k] / count[k]);
  return square;
}

double thread_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

const char* verdict_word(Diagnosis::Verdict verdict) {
  switch (verdict) {
    case Diagnosis::Verdict::clean: return "clean";
    case Diagnosis::Verdict::effects: return "effects";
    case Diagnosis::Verdict::unknown: break;
  }
  return "unknown";
}

Place place_of(const PlacedEffect& e) { return {e.effect->name(), e.joint}; }

/// Nothing, with the reason in `failure`, if no recording could be drawn.
std::optional<Recording> try_to_draw(const ArmModel& model, Kind kind, int index, double limit, Random& random,
                                     std::string& failure) {
  constexpr int kAttempts = 40;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    try {
      Recording recording = draw_recording(model, kind, index, limit, random);
      failure.clear();
      return recording;
    } catch (const std::runtime_error& error) {
      failure = error.what();
    }
  }
  return std::nullopt;
}

std::vector<TrueEffect> truth_of(const Recording& recording, const ArmModel& model) {
  std::vector<TrueEffect> truth;
  if (recording.hidden.empty()) return truth;
  const StrengthMeter meter(training_part(recording.training, !recording.holdout), model);
  for (const Hidden& h : recording.hidden) {
    const std::string acts = h.acts.effect->name();
    truth.push_back({.place = {h.right_name, h.acts.joint},
                     .form = acts == h.right_name ? "" : acts,
                     .size = relative_size(h.acts, model),
                     .strength = meter.strength(h.acts),
                     .parameters = true_parameters(h.acts, model)});
  }
  return truth;
}

void write_logs(const std::filesystem::path& folder, const Recording& recording) {
  std::filesystem::create_directories(folder);
  write_log(folder / "train.csv", recording.training);
  if (recording.holdout) write_log(folder / "holdout.csv", *recording.holdout);
}

/// What the diagnosis says, in the words of a result.
void take_over(const Diagnosis& d, const ArmModel& robot, Result& r) {
  r.verdict = verdict_word(d.verdict);
  for (const NamedEffect& e : d.effects) {
    Named named{place_of(e.effect), {}, {}};
    for (const Alternative& a : e.alternatives) named.alternatives.push_back(place_of(a.effect));
    for (const Estimated& p : e.parameters) named.parameters.push_back({p.name, p.value, p.lower, p.upper});
    r.named.push_back(std::move(named));
  }
  for (const Unexplained& u : d.unexplained) r.unexplained.push_back(u.joint + 1);
  r.before = d.before.joint_rms;
  r.after = d.after.joint_rms;
  r.true_model = joint_errors(d, robot);
}

}  // namespace

Result run_trial(const ArmModel& model, Kind kind, int index, const TrialOptions& options) {
  Random random(options.seed, static_cast<std::uint32_t>(kind), static_cast<std::uint32_t>(index));
  Result r;
  r.kind = kind;
  r.index = index;
  r.seed = options.seed;
  r.limit = options.limit;
  const std::optional<Recording> recording = try_to_draw(model, kind, index, options.limit, random, r.failure);
  if (!recording) return r;
  r.truth = truth_of(*recording, model);
  if (!options.logs.empty()) write_logs(options.logs / fmt::format("{}-{:06}", word(kind), index), *recording);

  const auto wall = std::chrono::steady_clock::now();
  const double cpu = thread_seconds();
  Diagnosis d;
  try {
    DiagnosisOptions how;
    how.tell_not_excited = false;  // is not asked for, and would take as long as a clean log's whole diagnosis
    d = diagnose(model, {recording->training}, recording->holdout, how);
  } catch (const std::exception& error) {
    r.failure = std::string("diagnose: ") + error.what();
    return r;
  }
  r.cpu_s = thread_seconds() - cpu;
  r.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  take_over(d, recording->robot, r);
  return r;
}

}  // namespace halyard::blind
