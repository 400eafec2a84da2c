#pragma once
/// Before the data: which effects would a diagnosis of an arm in this motion see, from what size on, and which of them
/// could it tell apart? The logs are of an arm that the model describes, as a simulation gives them.
///
///   d(p)   residual of the model if the arm had the effect at size p, less its residual as it is: to first order the
///          motors move as they did
///   r⊥     what the baseline's numbers leave of a residual r, each within its tolerance          (baseline_reach.h)
///
/// An effect is seen at size p if its change is what a diagnosis asks for (judge.h):
///
///   rms((r0 + d)⊥ - r0⊥) and rms(d) > kMattersFactor floors of a channel;
///   ms((r0 + d)⊥) - ms(r0⊥) > kMattersShare ms((r0 + d)⊥) in a channel;
///   ln L_b(r0⊥) - ln L_b((r0 + d)⊥) over the blocks b of time passes the t test at 1 % over the number of candidates
///   that a search fits, or adds up to more than the logarithm of that number over 1 %.
///
/// The detection limit is the smallest such size, to 9 %. At twice that size another effect is confused with it if its
/// best fit leaves so little that the gain of the right one over it,
///
///   Δ = Σ_b (ln L_b(r0⊥) - ln L_b(left)),
///
/// is less than kTellApart of its standard deviations: of √(2Δ), which noise of the floor's size gives it, so that
/// Δ < 8; or of what the blocks give it.
///
/// An effect's first size counts, to the side of its typical value. Of the shapes that follow it those that show most
/// at the typical size are taken, instants are spread over the record, positions are in the middle of the motion.

#include <functional>
#include <string>
#include <vector>

#include "model/arm_model.h"
#include "model/log.h"

namespace halyard {

struct DetectionLimit {
  PlacedEffect effect;                      ///< at the limit; at its largest size if not excited
  bool excited = false;                     ///< false: not seen even at its largest size
  std::string parameter, unit;              ///< the size that counts
  double neutral = 0;                       ///< its value without the effect
  double limit = 0;                         ///< its value at the limit, or the largest
  std::vector<PlacedEffect> confused_with;  ///< at twice the limit
};

/// Of every candidate that the model does not have already, in their fixed order. progress as in attribute().
/// Throws InputError for logs that cannot be compared with the model.
std::vector<DetectionLimit> detection_limits(const ArmModel& model, const std::vector<Log>& logs,
                                             const std::function<void(const std::string&, double)>& progress = {});

/// True if each joint moves along one sine or stands still: effects may be seen then, but a diagnosis names none.
bool names_nothing(const ArmModel& model, const std::vector<Log>& logs);

/// Two effects, and how alike they are in these logs.
struct Separation {
  DetectionLimit first, second;
  /// The cosine of the angle between what one effect leaves of the baseline and the nearest that the other can do; the
  /// larger of both ways, each at twice its limit; 1 if one of them is not excited.
  double cosine = 1;
  bool told_apart = false;  ///< both are seen, neither is confused with the other, and a diagnosis gives names at all
};

/// Throws as detection_limits() does.
Separation separation(const ArmModel& model, const std::vector<Log>& logs, const PlacedEffect& first,
                      const PlacedEffect& second);

}  // namespace halyard
