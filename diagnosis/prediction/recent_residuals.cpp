#include "diagnosis/prediction/recent_residuals.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/prediction/shared_lanes.h"
#include "transmission/arm_fields.h"

namespace halyard {

RecentResiduals::Key::Key(const Hypothesis& h, const Record& record, int stride, const RungeKuttaChebyshev& scheme,
                          bool is_replayed)
    : record_(&record),
      stride_(stride),
      steps_(scheme.steps),
      stages_(scheme.stages),
      is_replayed_(is_replayed),
      numbers_(past_states(h, record)) {
  const auto append = [&](const auto& number) { numbers_.push_back(static_cast<double>(number)); };
  const auto append_field = [&](const ArmField&, const auto& value) { for_each_entry(append, value); };
  for_each_arm_field(append_field, h.nominal);
  for (int k = 0; k < h.nominal.n; ++k) for_each_joint_field(append_field, h.nominal.joint[k]);
  for (const PlacedEffect& e : h.effects) {
    effects_.push_back(e.effect);
    append(e.joint.value_or(-1));
    numbers_.insert(numbers_.end(), e.p, e.p + kMaxEffectParameters);
  }
}

bool RecentResiduals::Key::can_be_found() const {
  return std::ranges::none_of(numbers_, [](double number) { return std::isnan(number); });
}

std::optional<Residuals> RecentResiduals::find(const Key& key) {
  const std::lock_guard lock(mutex_);
  const auto known = kept_.find(key);
  if (known == kept_.end()) return {};
  by_use_.splice(by_use_.end(), by_use_, known->second.use);
  return known->second.residuals;
}

std::size_t RecentResiduals::bytes_of(const Key& key, const Residuals& residuals) {
  std::size_t numbers = 0;
  for (const auto& channel : residuals.channel) numbers += channel.size();
  return key.bytes() + numbers * sizeof(double);
}

void RecentResiduals::keep(Key key, Residuals residuals) {
  const std::lock_guard lock(mutex_);
  std::list<const Key*> use(1);  // before the entry, which has a place in the list from the beginning
  const auto [place, is_new] = kept_.try_emplace(std::move(key));
  auto& [own_key, kept] = *place;
  if (is_new) {
    use.front() = &own_key;
    kept.use = use.begin();
    by_use_.splice(by_use_.end(), use);
  } else {
    bytes_ -= bytes_of(own_key, kept.residuals);
    by_use_.splice(by_use_.end(), by_use_, kept.use);
  }
  bytes_ += bytes_of(own_key, residuals);
  kept.residuals = std::move(residuals);
  while (bytes_ > most_bytes_ && kept_.size() > 1) {
    const auto oldest = kept_.find(*by_use_.front());
    bytes_ -= bytes_of(oldest->first, oldest->second.residuals);
    by_use_.pop_front();
    kept_.erase(oldest);
  }
}

}  // namespace halyard
