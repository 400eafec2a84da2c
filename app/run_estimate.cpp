#include "app/run_estimate.h"

#include <algorithm>

namespace halyard {
namespace {

std::string kind_of(const std::string& stage) { return stage.substr(0, stage.find(" of ")); }

}  // namespace

double RunEstimate::left(const std::string& stage, double fraction, double now) {
  if (stage != stage_) {
    if (!stage_.empty()) taken_[kind_of(stage_)] = now - started_;
    stage_ = stage;
    started_ = now;
  }
  const auto current = std::ranges::find(stages_, kind_of(stage), &UsualStage::kind);
  const double elapsed = now - started_;
  double sum = 0;
  if (fraction > 0) sum = elapsed * (1 - fraction) / fraction;
  else if (current != stages_.end()) sum = std::max(0.0, expected(*current) - elapsed);
  if (current != stages_.end())
    for (auto next = current + 1; next != stages_.end(); ++next) sum += expected(*next);
  return sum;
}

double RunEstimate::expected(const UsualStage& stage) const {
  const auto seen = taken_.find(stage.kind);
  return seen == taken_.end() ? stage.usual * scale() : seen->second;
}

double RunEstimate::scale() const {
  double taken = 0, usual = 0;
  for (const UsualStage& stage : stages_)
    if (const auto seen = taken_.find(stage.kind); seen != taken_.end()) taken += seen->second, usual += stage.usual;
  return usual > 0 ? taken / usual : 1;
}

}  // namespace halyard
