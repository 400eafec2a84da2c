#pragma once
/// The main job, all of halyard on one page: the paper's experiments, the diagnosis of a bundled log, and that of
/// recordings of real rigs where they are at hand.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/tour/tour_rigs.h"
#include "diagnosis/diagnose.h"
#include "evaluation/experiments/raven_experiments.h"
#include "evaluation/studies/diagnosis_evaluation.h"
#include "model/arm_model.h"

namespace halyard {

/// A model, what a diagnosis found that it lacks, and why.
struct DiagnosedModel {
  ArmModel model;
  Diagnosis diagnosis;
  DiagnosisEvaluation evaluation;
};

/// The tour looks for one effect a recording, to be done within a minute; halyard diagnose goes on.
inline constexpr int kMostEffectsOfRig = 1;

struct RigResult {
  Rig rig;
  std::optional<DiagnosedModel> diagnosed;  ///< none: the recordings are not at hand
};

struct Tour {
  std::vector<Experiment> experiments;
  DiagnosedModel bundled;                ///< raven2.xml by undeclared_effect.csv
  std::vector<PlacedEffect> undeclared;  ///< what undeclared_effect.xml says of that log; no diagnosis saw it
  std::vector<RigResult> rigs;
};

/// Computes all parts in parallel; the result does not depend on the number of threads.
/// progress(what, fraction of it) may be called from any thread, one at a time.
/// Throws as compute_experiments, read_model, read_log and diagnose do.
Tour compute_tour(const std::filesystem::path& examples, const std::filesystem::path& recordings,
                  const std::function<void(const std::string&, double)>& progress = {});

/// Writes report.html, and below the folder one folder each for the experiments and every diagnosis.
void write_tour(const std::filesystem::path& folder, const Tour& tour);

/// One parameter of an effect of the bundled log's robot beside what the diagnosis found.
struct FoundParameter {
  std::string effect, name, unit;
  double value = 0;
  const Estimated* found = nullptr;  ///< null: the diagnosis did not name the effect; points into the tour
};
std::vector<FoundParameter> found_parameters(const Tour& tour);

}  // namespace halyard
