#pragma once
/// Plans an experiment: which effects would a diagnosis detect in this motion, from which size on, and which of them
/// could it distinguish? The logs come from an arm that equals the model, for example from a simulation.
///
///   r0     residual of the model on these logs
///   d(p)   change of the residual if the arm had the effect at size p; to first order the motors' motion is the same
///   r⊥     part of a residual r that the baseline's parameters within their tolerances cannot explain
///          (baseline_reach.h)
///
/// An effect is detected at size p if it meets these conditions. They are those of a diagnosis (judge.h) for a log
/// whose only residual is r0. The t test is that of the gains themselves, and the likelihood ratio always counts:
///
///   change         rms((r0 + d)⊥ - r0⊥) and rms(d) each exceed a certain multiple of the floor in some channel
///   share          ms((r0 + d)⊥) - ms(r0⊥) exceeds a certain share of ms((r0 + d)⊥) in some channel
///   significance   the gains G_b = ln L_b(r0⊥) - ln L_b((r0 + d)⊥) of the blocks b of time pass a t test at the level
///                  1 % / n, or Σ_b G_b > ln(n / 1 %). Here n is the number of candidates that a search fits
///
/// The multiple and the share are those of a diagnosis (docs/diagnosis.md). The floor of a channel is the smallest
/// error that its sensor resolves, or its noise if that is larger.
///
/// The detection limit is the smallest such size, to 9 %. At twice the limit the effect is compared with the best fit
/// of every other effect, by the gain in log-likelihood of the right effect over the other:
///
///   Δ = Σ_b (ln L_b(r0⊥) - ln L_b(residual of the other's fit)).
///
/// The standard deviation σ of Δ is computed in two ways: as √(2Δ), for noise of the floor's size, and from the blocks.
/// The two effects are confused if Δ < 2 σ for at least one of these two values of σ. For the first value the condition
/// is Δ < 8.
///
/// The naming limit is the smallest size from the detection limit on, to 9 %, at which the effect is confused with no
/// other. Between the two limits a diagnosis sees that something is there, but another name may fit as well.
///
/// The size of an effect is its first size parameter, on the same side of neutral as its typical value. Its shape
/// parameters take the values with the largest change of the residual at the typical size. A shape parameter that is an
/// instant is placed within the record; several instants of one effect are spread over it. A shape parameter that is a
/// joint position is placed in the middle of the joint's motion.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

struct DetectionLimit {
  PlacedEffect effect;                      ///< at the limit; at its largest size if not excited
  bool excited = false;                     ///< false: not detected even at its largest size, or too few of its periods
  std::string parameter, unit;              ///< the size parameter
  double neutral = 0;                       ///< value of the size parameter without the effect
  double limit = 0;                         ///< its value at the limit; its largest value if not excited
  std::vector<PlacedEffect> confused_with;  ///< at twice the limit
  std::optional<double> naming_limit;       ///< value of the size parameter; none: another effect always fits as well
};

/// Detection limits of all candidates that the model does not have already, in a fixed order. progress(what, fraction)
/// is called repeatedly, by several threads at once.
/// Throws InputError for logs that cannot be compared with the model.
std::vector<DetectionLimit> detection_limits(const ArmModel& model, const std::vector<Log>& logs,
                                             const std::function<void(const std::string&, double)>& progress = {});

/// The smallest share of an effect's given sizes at which the effect is detected. All sizes are scaled together, from
/// their neutral values; at a share of 1 they are as given. Infinite if the effect is not detected even at the given
/// sizes. Shapes stay as they are. One entry for each effect; each is looked at alone. Throws as detection_limits()
/// does.
std::vector<double> detected_from(const ArmModel& model, const std::vector<Log>& logs,
                                  const std::vector<PlacedEffect>& effects);

/// The smallest share of an effect's given sizes at which the effect is detected and confused with no other; infinite
/// if there is none, or if a diagnosis does not try these shapes in this motion, for example an order of too few
/// periods. Throws as detection_limits() does.
double named_from(const ArmModel& model, const std::vector<Log>& logs, const PlacedEffect& effect);

/// True if each joint moves along one sine or stands still. A diagnosis may then detect effects, but names none.
bool names_nothing(const ArmModel& model, const std::vector<Log>& logs);

/// Two effects, and how similar their changes of the residual are in these logs.
struct Separation {
  DetectionLimit first, second;
  /// Cosine of the angle between d⊥ and a fit. d⊥ is the change of the residual by one effect at twice its limit; the
  /// other effect is fitted to it. Computed both ways; this is the larger value. 1 if one of them is not excited.
  double cosine = 1;
  bool told_apart = false;  ///< both are detected, neither is confused with the other, and names_nothing() is false
};

/// Throws as detection_limits() does.
Separation separation(const ArmModel& model, const std::vector<Log>& logs, const PlacedEffect& first,
                      const PlacedEffect& second);

}  // namespace halyard
