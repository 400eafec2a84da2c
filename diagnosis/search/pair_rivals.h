#pragma once
/// Names that were given one after the other, and two other effects at the joint that explain the log as well, although
/// neither could win a round of the search:
///
/// - Two names for two others. Dry friction and its presliding on the side of the motor look like both on the side of
///   the joint, but neither can be replaced alone: beside the other one it is on the wrong side.
/// - One name for two others. While frictions of a motor and of its pulleys are both missing, the friction of the joint
///   may gain more than either, and leave too little for a further name.
///
/// The rivals of a name are the candidates at its joint that gained nearly as much in a round that it led. Pairs of
/// rivals compete with the names by their log-likelihood on the deciding blocks (name_probability.h), so that the
/// probability of a name counts these pairs, too. The most probable pair is named.

#include "diagnosis/round/refit.h"
#include "diagnosis/search/attribution.h"

namespace halyard {

class PairRivals {
 public:
  /// given: number of effects that the model came with.
  PairRivals(const Evidence& evidence, const ArmModel& model, const Refitter& refitter, const Judge& judge,
             std::size_t given, const AttributionOptions& options)
      : evidence_(evidence), model_(model), refitter_(refitter), judge_(judge), given_(given), options_(options) {}

  /// Weighs every name, and then every two names at one joint, against the pairs of their rivals in the search's
  /// rounds: final_fit, final_score and namings change.
  void weigh(Attribution& found) const;

 private:
  /// Indices of one or two effects, in ascending order.
  using Places = std::vector<std::size_t>;
  struct Pair;
  struct Contest;
  bool can_be_named(const Pair& pair) const;
  std::vector<Pair> pairs(const Attribution& found, const Places& places) const;
  std::vector<Contest> contests(const Attribution& found, const std::vector<Places>& of_names) const;
  void decide(Attribution& found, std::vector<Places> of_names) const;
  std::vector<double> weights(const Attribution& found, const Places& places, const Hypothesis& none,
                              const std::vector<Pair>& pairs) const;
  bool weigh(Attribution& found, const Contest& contest) const;
  static void doubt(Naming& naming, const Pair& pair);
  void add_alternatives(Attribution& found, const Places& places, const std::vector<Pair>& pairs,
                        const std::vector<double>& weight) const;
  static Naming naming_of(const PlacedEffect& effect, const PlacedEffect& other, const std::vector<Pair>& pairs,
                          const std::vector<double>& weight, Naming naming, const PlacedEffect& before);
  void take_the_place(Attribution& found, const Places& places, const std::vector<Pair>& pairs,
                      const std::vector<double>& weight, std::size_t best) const;

  const Evidence& evidence_;
  const ArmModel& model_;
  const Refitter& refitter_;
  const Judge& judge_;
  std::size_t given_;
  const AttributionOptions& options_;
};

}  // namespace halyard
