/// Accuracy and cost of the built-in filters on simulated records and on logs of the second simulator: one table row
/// for each record and filter. The filters know the robot's effects.
///
///   position   RMS error of each joint, µrad | µm
///   NEES       mean of (error / stated standard deviation)², over the joints; moving and resting samples
///   µs         one update, by the processor's time of this thread
///
/// Other simulated records than A, B, C and the one with rounding only have the noise that the filters assume, so that
/// the expected NEES is one.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>

#include "bench/program.h"
#include "bench/thread_time.h"
#include "estimators/filters/arm_filter.h"
#include "estimators/filters/ekf.h"
#include "estimators/filters/sr_ukf.h"
#include "estimators/log_sample.h"
#include "evaluation/comparison/assumed_noise.h"
#include "model/model_file.h"
#include "plant/simulate.h"

namespace halyard {
namespace {

struct Record {
  std::string name;
  ArmModel model;  ///< that the filters believe
  Log measured, truth;
};

JointTrajectory moves_with_dwells(const JointDescription& joint, bool revolute, int k) {
  JointTrajectory t;
  t.kind = JointTrajectory::Kind::point_to_point;
  const double reach = (revolute ? 0.3 : 0.03) * (1 - 0.2 * k);
  t.points = {joint.home, joint.home + reach, joint.home - reach, joint.home + 0.5 * reach};
  t.move_s = 0.6 + 0.1 * k;
  t.dwell_s = 0.9 - 0.1 * k;
  return t;
}

ArmFilterOptions usual_options(const ArmModel& model, const ProcessModel& process) {
  const EstimatorOptions none;
  OptionReader reader("accuracy", none);
  return read_arm_filter_options(reader, model, process);
}

enum class Noise { assumed, rounding };

Record dwells(const std::string& name, const ArmModel& model, double duration_s, Noise noise = Noise::assumed,
              double period_s = 1e-3) {
  Scenario s;
  s.robot = model;
  for (JointParameters<double>& j : s.robot.nominal.joint) j.motor_encoder_noise = 0;  // in the noise that is drawn
  s.name = name;
  s.duration_s = duration_s;
  for (int k = 0; k < model.n(); ++k)
    s.trajectory.push_back(moves_with_dwells(model.joints[k], model.nominal.joint[k].type == JointType::revolute, k));
  s.control_period_s = period_s;
  s.quantise = noise == Noise::rounding;
  if (noise == Noise::assumed) s.noise = assumed_noise(model, s.control_period_s);
  const SimulationResult result = simulate(faster(s));
  return {name, model, result.measured, result.truth};
}

Record experiment(const std::string& letter, double duration_s) {
  Scenario s = read_scenario(HALYARD_SOURCE_DIR "/examples/raven2/experiment_" + letter + ".xml");
  s.duration_s = duration_s;
  const SimulationResult result = simulate(faster(s));
  return {letter, s.robot, result.measured, result.truth};
}

/// Each effect in turn, at the first joint that can have it from the last on, or on the whole arm.
std::vector<Record> effects(const ArmModel& model, double duration_s, const std::string& only) {
  std::vector<Record> all;
  for (const Effect* effect : effect_library()) {
    if (!only.empty() && effect->name() != only) continue;
    ArmModel with = model;
    const std::vector<EffectPlace> places = effect_places(*effect, model.nominal);
    if (places.empty()) continue;
    with.effects.push_back(place_effect(*effect, model.nominal, places.back()));
    all.push_back(dwells(effect_label(with.effects.back()), with, duration_s));
  }
  return all;
}

/// The motion of the bundled log with a backlash, and motions that are a little faster; by a model that knows the gap.
/// Where the joint hangs in its gap depends on small differences, so that one record alone shows little.
std::vector<Record> backlash_motions() {
  std::vector<Record> all;
  for (int i = 0; i < 8; ++i) {
    Scenario s = read_scenario(HALYARD_SOURCE_DIR "/examples/raven2/undeclared_effect.xml");
    for (JointTrajectory& t : s.trajectory)
      for (auto& sine : t.sines) sine.frequency_hz *= 1 + 0.04 * i;
    const SimulationResult result = simulate(faster(s));
    all.push_back({fmt::format("backlash, motion {}", i + 1), s.robot, result.measured, result.truth});
  }
  return all;
}

ArmModel smoother_by(ArmModel model, double factor) {
  for (int k = 0; k < model.n(); ++k) {
    model.nominal.joint[k].motor_smoothing *= factor;
    model.nominal.joint[k].joint_smoothing *= factor;
  }
  return model;
}

void run(const Record& record, const std::string& name, Estimator& estimator) {
  const int n = record.measured.n_joints;
  std::vector<double> sum(n, 0.0);
  double nees[2] = {0, 0}, spread = 0;
  long count[2] = {0, 0};
  estimator.reset(sample_of(record.measured, 0));
  double busy = 0;
  for (std::size_t i = 1; i < record.measured.size(); ++i) {
    const Sample sample = sample_of(record.measured, i);
    const double before = thread_time_s();
    estimator.update(sample);
    busy += thread_time_s() - before;
    if (sample.time_s < 0.5) continue;
    const Estimate e = estimator.estimate();
    double fastest = 0;
    for (int k = 0; k < n; ++k) {
      const double moved = record.truth.joint_position[k][i] - record.truth.joint_position[k][i - 1];
      fastest = std::max(fastest, std::abs(moved) / (sample.time_s - record.truth.time[i - 1]));
    }
    const int at_rest = fastest < 5e-3;  // rad/s | m/s
    ++count[at_rest];
    for (int k = 0; k < n; ++k) {
      const double error = e.joint_position(k) - record.truth.joint_position[k][i];
      sum[k] += error * error;
      spread += e.joint_position_std(k);
      nees[at_rest] += error * error / (e.joint_position_std(k) * e.joint_position_std(k)) / n;
    }
  }
  const long all = count[0] + count[1];
  fmt::print("{:28} {:10}", record.name, name);
  for (int k = 0; k < n; ++k) fmt::print(" {:9.4f}", 1e6 * std::sqrt(sum[k] / double(all)));
  fmt::print("  {:8.4f} {:8.4f}  {:6.2f}\n", nees[0] / double(std::max(count[0], 1L)),
             nees[1] / double(std::max(count[1], 1L)), 1e6 * busy / double(record.measured.size() - 1));
  std::fflush(stdout);
}

}  // namespace
}  // namespace halyard

int main(int argc, char** argv) {
  using namespace halyard;
  CLI::App app("Accuracy and cost of the filters");
  double duration_s = 20, effect_duration_s = 6;
  std::string only, group = "all";
  bool sub_steps = false;
  app.add_option("--duration", duration_s, "of A, B, C, dwells, s");
  app.add_option("--effect-duration", effect_duration_s, "of the record of each effect, s");
  app.add_option("--effect", only, "only this effect");
  app.add_option("--group", group, "which records")
      ->check(CLI::IsMember({"experiments", "dwells", "rig", "backlash", "effects", "all"}));
  app.add_flag("--sub-steps", sub_steps, "switch the exponential step off");
  return run_program(app, argc, argv, [&] {
    if (!only.empty() && !find_effect(only)) throw InputError("--effect: the library has no effect " + in_quotes(only));
    const ArmModel raven = read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml");
    std::vector<Record> records;
    const auto wanted = [&](const char* name) { return group == "all" || group == name; };
    if (wanted("experiments"))
      for (const char* letter : {"a", "b", "c"}) records.push_back(experiment(letter, duration_s));
    if (wanted("dwells")) {
      records.push_back(dwells("dwells", raven, duration_s));
      records.push_back(dwells("dwells, rounding only", raven, duration_s, Noise::rounding));
      records.push_back(dwells("dwells, 200 Hz", raven, duration_s, Noise::assumed, 5e-3));
      records.push_back(dwells("dwells, sharper friction", smoother_by(raven, 0.3), duration_s));
      records.push_back(dwells("dwells, exponential cables",
                               read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2_exponential.xml"), duration_s));
    }
    if (wanted("rig"))
      for (const char* log : {"clean-1", "clean-2"}) {
        const std::filesystem::path path = std::filesystem::path(HALYARD_SHARED_DATA) / "rig" / log / "train.csv";
        if (!std::filesystem::exists(path)) continue;
        const Log data = read_log(path, 3);
        records.push_back({log, raven, data, data});
      }
    if (wanted("backlash"))
      for (Record& r : backlash_motions()) records.push_back(std::move(r));
    if (wanted("effects"))
      for (Record& r : effects(raven, effect_duration_s, only)) records.push_back(std::move(r));
    fmt::print("{:28} {:10} {:>29}  {:>8} {:>8}  {:>6}\n", "record", "filter", "position", "NEES mov", "NEES rest",
               "us");
    for (const Record& record : records) {
      const auto process = std::make_shared<const ProcessModel>(record.model);
      ArmFilterOptions options = usual_options(record.model, *process);
      options.exponential = !sub_steps;
      const UkfWeights weights{.curvature_limit = 0.03};  // as the plug-in has it
      ArmFilter ekf(record.model, process, options, std::make_unique<ExtendedKalmanFilter>());
      ArmFilter ukf(record.model, process, options, std::make_unique<SquareRootUkf>(weights));
      run(record, "ekf", ekf);
      run(record, "sr_ukf", ukf);
    }
    return 0;
  });
}
