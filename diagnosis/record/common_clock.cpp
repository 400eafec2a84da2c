#include "diagnosis/record/common_clock.h"

#include <algorithm>
#include <limits>

#include "diagnosis/search_space.h"

namespace halyard {
namespace {

constexpr double kApart = 1;  ///< s between two logs: nothing at the end of one reaches into the next

void move_instants(PlacedEffect& e, const ArmParameters<double>& arm, double seconds) {
  for (const std::size_t i : instants_of(e, arm)) e.p[i] += seconds;
}

}  // namespace

std::vector<double> clock_shifts(const std::vector<Log>& logs) {
  std::vector<double> shifts;
  double end = -std::numeric_limits<double>::infinity();
  for (const Log& log : logs) {
    shifts.push_back(std::max(0.0, end + kApart - log.time.front()));
    end = log.time.back() + shifts.back();
  }
  return shifts;
}

Hypothesis on_own_clock(const Record& record, Hypothesis h) {
  if (record.clock_shift == 0) return h;
  for (PlacedEffect& e : h.effects) move_instants(e, h.nominal, -record.clock_shift);
  return h;
}

const Record* record_of(const PlacedEffect& effect, const ArmParameters<double>& arm,
                        const std::vector<Record>& records) {
  if (!is_event(effect, arm)) return nullptr;
  const std::vector<std::size_t> instants = instants_of(effect, arm);
  const double first = effect.p[instants.front()], last = effect.p[instants.back()];
  const auto overlap = [&](const Record& r) {
    return std::min(last, r.time(r.size - 1) + r.clock_shift) - std::max(first, r.start + r.clock_shift);
  };
  return &*std::ranges::max_element(records, {}, overlap);
}

PlacedEffect on_clock_of_its_log(PlacedEffect effect, const ArmParameters<double>& arm,
                                 const std::vector<Record>& records) {
  if (const Record* const r = record_of(effect, arm, records)) move_instants(effect, arm, -r->clock_shift);
  return effect;
}

Hypothesis on_clocks_of_their_logs(Hypothesis h, std::size_t first, const ArmParameters<double>& arm,
                                   const std::vector<Record>& records) {
  for (std::size_t e = first; e < h.effects.size(); ++e) h.effects[e] = on_clock_of_its_log(h.effects[e], arm, records);
  return h;
}

}  // namespace halyard
