#pragma once
/// Results of blind trials that were never run, and the model and the effects that their tests share.

#include "bench/diagnosis/summary/selection.h"
#include "model/model_file.h"

namespace halyard::blind {

/// A trial with an effect at a joint that `--plan` promises to see.
inline TrueEffect true_effect(const std::string& effect, int joint, std::vector<TrueParameter> parameters = {}) {
  return {.place = {effect, joint}, .form = "", .size = 1, .parameters = std::move(parameters)};
}

inline const TrueEffect kBacklash = true_effect("backlash", 1), kCreep = true_effect("creep", 1);

inline const ArmModel& raven2() {
  static const ArmModel model = read_model(HALYARD_SOURCE_DIR "/examples/raven2/raven2.xml");
  return model;
}

inline Named named(const std::string& effect, int joint, double probability = 0.99,
                   std::vector<Alternative> alternatives = {}, std::vector<Parameter> parameters = {}) {
  return {{effect, joint}, probability, std::move(alternatives), std::move(parameters)};
}

inline Result trial(Kind kind, std::vector<TrueEffect> truth, std::vector<Named> names) {
  Result r;
  r.situation = {kind, Sensors::good, 1, Arms::raven2};
  r.arm = "RAVEN-II";
  r.joints = 3;
  r.truth = std::move(truth);
  r.verdict = names.empty() ? "clean" : "effects";
  r.named = std::move(names);
  return r;
}

inline Results pointers(const std::vector<Result>& all) {
  Results list;
  for (const Result& r : all) list.push_back(&r);
  return list;
}

}  // namespace halyard::blind
