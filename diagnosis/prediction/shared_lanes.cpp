#include "diagnosis/prediction/shared_lanes.h"

#include <algorithm>

namespace halyard {
namespace {

using Place = std::vector<PlacedEffect>::const_iterator;

/// The first effect of that name at that joint from `first` on.
Place find_from(Place first, Place last, const PlacedEffect& effect) {
  return std::find_if(first, last, [&](const PlacedEffect& e) { return same_name(e, effect); });
}

CommonEffects common_effects(const std::vector<const Hypothesis*>& hypotheses) {
  CommonEffects common;
  for (const Hypothesis* h : hypotheses) common.add(h->effects);
  return common;
}

/// Neutral in the lanes of hypotheses that do not have them.
std::vector<EffectInstance<Lanes>> packed_effects(const CommonEffects& common, const FilteredEffects& seen,
                                                  const std::vector<const Hypothesis*>& hypotheses) {
  std::vector<EffectInstance<Lanes>> packed;
  for (std::size_t e = 0; e < common.all().size(); ++e) {
    const PlacedEffect& any = common.all()[e];
    const PlacedEffect neutral = place_neutral_effect(*any.effect, hypotheses[0]->nominal, any.joint);
    packed.push_back({seen[e], any.joint, {}});
    for (int i = 0; i < kMaxEffectParameters; ++i) packed.back().p[i] = neutral.p[i];
  }
  for (int l = 0; l < kLaneWidth; ++l) {
    const Hypothesis& h = *hypotheses[l < std::ssize(hypotheses) ? l : 0];
    const std::vector<std::size_t> places = common.places(h.effects);
    for (std::size_t e = 0; e < places.size(); ++e)
      for (int i = 0; i < kMaxEffectParameters; ++i) packed[places[e]].p[i].set(l, h.effects[e].p[i]);
  }
  return packed;
}

ArmParameters<Lanes> packed_arms(const std::vector<const Hypothesis*>& hypotheses) {
  ArmParameters<double> arms[kLaneWidth];
  for (int l = 0; l < kLaneWidth; ++l) arms[l] = hypotheses[l < std::ssize(hypotheses) ? l : 0]->nominal;
  return pack(arms);
}

}  // namespace

void CommonEffects::add(const std::vector<PlacedEffect>& effects) {
  std::ptrdiff_t next = 0;
  for (const PlacedEffect& e : effects) {
    const Place found = find_from(all_.begin() + next, all_.end(), e);
    if (found == all_.end()) all_.insert(all_.begin() + next, e);
    else next = found - all_.begin();
    ++next;
  }
}

int CommonEffects::n_states() const {
  int n = 0;
  for (const PlacedEffect& e : all_) n += e.effect->n_states();
  return n;
}

std::vector<std::size_t> CommonEffects::places(const std::vector<PlacedEffect>& effects) const {
  std::vector<std::size_t> places;
  Place next = all_.begin();
  for (const PlacedEffect& e : effects) {
    next = find_from(next, all_.end(), e);
    places.push_back(static_cast<std::size_t>(next++ - all_.begin()));
  }
  return places;
}

SharedLanes::SharedLanes(std::vector<const Hypothesis*> hypotheses, const Record& record)
    : record_(record),
      hypotheses_(std::move(hypotheses)),
      effects_(common_effects(hypotheses_)),
      seen_(effects_.all(), hypotheses_[0]->nominal, record.motion_sigma,
            record.compare_sigma > 0 ? record.motion_sigma : 0),  // else the readings themselves are compared
      transmission_(packed_arms(hypotheses_), packed_effects(effects_, seen_, hypotheses_)) {
  std::vector<int> first;  // state of each effect
  int n = 0;
  for (const PlacedEffect& e : effects_.all()) {
    first.push_back(n);
    n += e.effect->n_states();
  }
  for (const Hypothesis* h : hypotheses_) {
    states_.emplace_back();
    for (const std::size_t place : effects_.places(h->effects))
      for (int s = 0; s < effects_.all()[place].effect->n_states(); ++s) states_.back().push_back(first[place] + s);
  }
}

void SharedLanes::add_past(Lanes* z) const {
  for (int l = 0; l < kLaneWidth; ++l) {
    const std::size_t i = l < std::ssize(hypotheses_) ? static_cast<std::size_t>(l) : 0;
    const std::vector<double> past = past_states(*hypotheses_[i], record_);
    for (std::size_t s = 0; s < past.size(); ++s) {
      Lanes& state = z[states_[i][s]];
      state.set(l, state[l] + past[s]);
    }
  }
}

std::vector<double> past_states(const Hypothesis& h, const Record& record) {
  std::vector<double> all;
  for (std::size_t e = 0; e < h.effects.size(); ++e) {
    const auto states = static_cast<std::size_t>(h.effects[e].effect->n_states());
    for (std::size_t s = 0; s < states; ++s)
      all.push_back(record.place ? h.past_state(e, *record.place * states + s) : 0.0);
  }
  return all;
}

}  // namespace halyard
