#pragma once
/// Which candidate of a round is named, and which others these data cannot tell from it.

#include "diagnosis/diagnose.h"
#include "diagnosis/judgement/judge.h"

namespace halyard {

/// Of an effect: cost_of_effect, and cost_of_number for each of its numbers (decision_rule.h). An equation of its own
/// counts like one more number.
double prior_cost_of(const PlacedEffect& effect, const ArmParameters<double>& arm);

/// A cause that the library does not have (unlisted_causes.h).
struct Unlisted {
  double weight = 0;    ///< against the name
  std::string summary;  ///< as of an effect
};

/// How an effect came to its name.
struct Naming {
  double weight = 0;                      ///< among the candidates of its round, see name_probability.h
  std::vector<Alternative> alternatives;  ///< with their weights as probabilities, the most probable first
  /// The most probable of those that are more probable than the name, but cannot be named: at a bound, for example.
  std::optional<PlacedEffect> surer = {};
  Unlisted unlisted = {};
};

/// That the name or one of its alternatives is right. none: probability that no name is (name_probability.h).
double probability_of_any_name(const Naming& naming, double none);

/// The probability that is told of a name or an alternative of this weight, see right_if_certain of decision_rule.h.
double told_probability(double weight, double none);

/// For each trial: it can be named, and its gain is significant at this false discovery rate. A candidate that cannot
/// be named counts among the tests but not among the discoveries.
std::vector<bool> convincing(const std::vector<Trial>& trials, double significance);

/// The trials of one round. Each adds one effect to the same hypothesis, `without`.
class Competition {
 public:
  Competition(const Evidence& evidence, const ArmModel& model, const Judge& judge, const Scored& without,
              const std::vector<Trial>& trials);

  struct Choice {
    std::size_t named;
    std::vector<std::size_t> alike;  ///< trials that the data cannot tell from the best one, including the named one
  };
  /// Chooses among the trials `able`; there must be at least one. Of those that the data cannot tell from the best, the
  /// most probable is named.
  Choice choose(const std::vector<std::size_t>& able) const;
  /// The weights of a name and of the candidates that explain the same part of the residual.
  Naming naming(const Choice& choice) const;
  /// The weight of "no effect" against all candidates that could be named.
  double weight_of_no_effect() const;

 private:
  std::vector<double> weights(const std::vector<std::size_t>& rivals) const;

  const Evidence& evidence_;
  const ArmModel& model_;
  const Judge& judge_;
  const Scored& without_;
  const std::vector<Trial>& trials_;
  Likelihood ln_without_;
};

}  // namespace halyard
