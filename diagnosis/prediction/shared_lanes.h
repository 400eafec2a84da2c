#pragma once
/// Hypotheses with different effects side by side in the lanes of one transmission. An effect that only some of them
/// have is neutral in the other lanes.

#include <vector>

#include "diagnosis/motion/motion_kernel.h"
#include "diagnosis/prediction/filtered_effect.h"
#include "diagnosis/prediction/prediction.h"

namespace halyard {

/// Effects that contain those of several hypotheses, each in its order.
class CommonEffects {
 public:
  /// Adds what the list has and the others do not.
  void add(const std::vector<PlacedEffect>& effects);
  const std::vector<PlacedEffect>& all() const { return all_; }
  int n_states() const;
  /// [effect of the list] its index in all(). The list has to be one of those that were added.
  std::vector<std::size_t> places(const std::vector<PlacedEffect>& effects) const;

 private:
  std::vector<PlacedEffect> all_;
};

/// Up to kLaneWidth hypotheses, packed; lanes that are left over repeat the first. Hypotheses and record have to
/// outlive this object.
class SharedLanes {
 public:
  SharedLanes(std::vector<const Hypothesis*> hypotheses, const Record& record);

  const Transmission<Lanes>& transmission() const { return transmission_; }
  int n_states() const { return transmission_.n_states(); }
  /// Adds the past of each hypothesis to the states of its lane.
  void add_past(Lanes* z) const;
  /// Indices of a hypothesis' own states among those of the lanes, in the order of its effects.
  const std::vector<int>& states_of(std::size_t lane) const { return states_[lane]; }

 private:
  const Record& record_;
  std::vector<const Hypothesis*> hypotheses_;
  CommonEffects effects_;
  FilteredEffects seen_;
  std::vector<std::vector<int>> states_;  ///< [hypothesis]
  Transmission<Lanes> transmission_;
};

/// Of all effects of a hypothesis at the start of a record, one after another.
std::vector<double> past_states(const Hypothesis& h, const Record& record);

}  // namespace halyard
