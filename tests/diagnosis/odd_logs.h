#pragma once
/// Logs of small arms that a test spoils and has diagnosed.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "diagnosis/diagnose.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {

inline PlacedEffect placed(const std::string& name, const ArmModel& model, int joint, const std::vector<double>& p) {
  PlacedEffect e = place_neutral_effect(*find_effect(name), model.nominal, joint);
  for (std::size_t i = 0; i < p.size(); ++i) e.p[i] = p[i];
  return e;
}

struct Logs {
  Log train, holdout;
};

inline constexpr double kLogDuration = 5;  // s

inline Logs logs_of(const ArmModel& truth, double duration = kLogDuration) {
  return {simulate(motion(truth, duration)).measured, simulate(motion(truth, 2.5, 1)).measured};
}

inline DiagnosisOptions quick() {
  DiagnosisOptions options;
  options.most_effects = 1;
  options.tell_not_excited = false;
  return options;
}

inline Diagnosis diagnosis_of(const ArmModel& model, const Logs& logs) {
  return diagnose(model, {logs.train}, logs.holdout, quick());
}

/// The one-joint arm's logs are simulated once: as the model says, and with a capstan that is 2 % larger.
inline constexpr double kLargerRatio = 1.02;
inline const Logs& clean_logs() {
  static const Logs logs = logs_of(first_joints(1));
  return logs;
}
inline const Logs& larger_logs() {
  static const Logs logs = [] {
    ArmModel truth = first_joints(1);
    truth.effects.push_back(placed("capstan_ratio", truth, 0, {kLargerRatio}));
    return logs_of(truth);
  }();
  return logs;
}

inline void expect_clean(const Diagnosis& d) {
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::clean);
  for (const NamedEffect& e : d.effects) ADD_FAILURE() << e.effect.effect->name() << " " << e.effect.p[0];
  for (const Unexplained& u : d.unexplained) ADD_FAILURE() << u.signature;
}

inline void expect_named(const Diagnosis& d, const std::string& name, int joint, double value, double within) {
  ASSERT_EQ(d.effects.size(), 1u) << (d.unexplained.empty() ? "clean" : d.unexplained[0].signature) << ", joint error "
                                  << d.before.joint_rms[0];
  EXPECT_EQ(d.effects[0].effect.effect->name(), name);
  EXPECT_EQ(d.effects[0].effect.joint, joint);
  EXPECT_NEAR(d.effects[0].effect.p[0], value, within * std::abs(value));
}

/// The spoilt logs of the right model leave it clean.
template <class Spoil>
void expect_clean_of(const ArmModel& model, const Spoil& spoil) {
  Logs logs = clean_logs();
  spoil(logs.train), spoil(logs.holdout);
  expect_clean(diagnosis_of(model, logs));
}

/// And the larger capstan is still found.
template <class Spoil>
void expect_larger_of(const ArmModel& model, const Spoil& spoil) {
  Logs logs = larger_logs();
  spoil(logs.train), spoil(logs.holdout);
  expect_named(diagnosis_of(model, logs), "capstan_ratio", 0, kLargerRatio, 1e-3);
}

}  // namespace halyard
