#pragma once
/// The tour shows halyard on one page: the paper's experiments, the diagnosis of a bundled log, and the diagnosis of
/// recordings of real rigs if they are available.

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
#include "model/output/output_files.h"

namespace halyard {

/// A model, its diagnosis, and the evidence.
struct DiagnosedModel {
  ArmModel model;
  Diagnosis diagnosis;
  DiagnosisEvaluation evaluation;
};

/// The tour searches for one effect per recording, to finish within a minute; halyard diagnose searches for more.
inline constexpr int kMostEffectsOfRig = 1;

struct RigResult {
  Rig rig;
  std::optional<DiagnosedModel> diagnosed;  ///< none: the recordings are not available
};

struct Tour {
  std::vector<Experiment> experiments;
  DiagnosedModel bundled;                ///< diagnosis of raven2.xml with undeclared_effect.csv
  std::vector<PlacedEffect> undeclared;  ///< true effects of that log, from undeclared_effect.xml; not used to diagnose
  std::vector<RigResult> rigs;
};

/// Computes all parts in parallel; the result does not depend on the number of threads.
/// progress(what, fraction of it) may be called from any thread, but never by two at once.
/// Throws as compute_experiments, read_model, read_log and diagnose do.
Tour compute_tour(const std::filesystem::path& examples, const std::filesystem::path& recordings,
                  const std::function<void(const std::string&, double)>& progress = {});

/// Adds report.html, and one sub-folder for the experiments and one for every diagnosis.
void write_tour(OutputFiles& files, const std::filesystem::path& folder, const Tour& tour);

/// One parameter of an effect of the bundled log's robot, with the diagnosis' estimate.
struct FoundParameter {
  std::string effect, name, unit;
  double value = 0;
  const Estimated* found = nullptr;  ///< null: the diagnosis did not name the effect; points into the tour
};
std::vector<FoundParameter> found_parameters(const Tour& tour);

}  // namespace halyard
