#pragma once
/// Two effects of a kind at one joint that are one. An effect may have several sizes: an external force is a push, a
/// contact, or both. Each round of the search finds what is largest then, so that the push and the contact of one
/// effect may be found in two rounds. Where the fit has kept different sizes of the two, one effect has them all and
/// predicts the same.

#include <optional>

#include "diagnosis/fit/fit.h"

namespace halyard {

/// Where to start a fit with the two as one: the effect `gone` is missing, and what the fit had kept of it belongs to
/// the effect `kept` < `gone`.
struct Joined {
  Hypothesis hypothesis;
  std::vector<FitParameter> parameters;
  std::size_t kept, gone;
};

/// The first two effects from `given` on, at the same joint and of the same kind, that have no size in common in the
/// fit. A size that is a smaller share of the other's than number_misfit (decision_rule.h) does not count: it mends an
/// error of the other's numbers. Effects with internal states are not joined: each has a past of its own.
std::optional<Joined> join_complementary(const Fit& fit, std::size_t given);

}  // namespace halyard
