#include "bench/diagnosis/summary/trials_csv.h"

#include <fmt/ranges.h>

#include "bench/diagnosis/summary/calibration.h"

namespace halyard::blind {
namespace {

std::string joined(const std::vector<std::string>& all) { return fmt::format("{}", fmt::join(all, "; ")); }

std::string probability(const std::optional<double>& p) { return p ? fmt::format("{:.4g}", *p) : ""; }

std::string line_of(const Result& r) {
  std::vector<std::string> truth, seen_from, named_from, named, probabilities, alternatives;
  for (const TrueEffect& t : r.truth) {
    truth.push_back(label(t.place) + (t.form.empty() ? "" : " as " + t.form));
    seen_from.push_back(fmt::format("{:.3g}", t.seen_from));
    named_from.push_back(fmt::format("{:.3g}", t.named_from));
  }
  for (const Named& n : r.named) {
    named.push_back(label(n.place));
    probabilities.push_back(fmt::format("{:.4g}", n.probability));
    for (const Alternative& a : n.alternatives) alternatives.push_back(label(a.place));
  }
  std::string failure = r.failure;
  std::ranges::replace_if(
      failure, [](char c) { return c == ',' || c == '\n'; }, ';');
  const bool ran = r.failure.empty();
  const auto of_truth = [&](const HoldOutErrors& e) { return ran ? error_ratio(e.after, e.true_model).worst : 0; };
  const double of_given = ran ? error_ratio(r.holdout.after, r.holdout.before).worst : 0;
  return fmt::format(
      "{},{},{},{},{},{},{},{:.0f},{:.4f},{},{},{},{},{},{},{},{},{},{},{},{},{},{:.4g},{:.4g},{:.4g},{:.2f}\n",
      word(r.situation.kind), word(r.situation.sensors), r.situation.off, r.index, r.seed, r.arm, r.joints,
      r.joint_rate_hz, r.latency_s, failure, joined(truth), joined(seen_from), joined(named_from), r.verdict,
      joined(named), joined(probabilities), joined(alternatives), fmt::join(r.unexplained, "; "),
      probability(r.probability_clean), probability(r.probability_none), strictly_right(r) ? 1 : 0,
      loosely_right(r) ? 1 : 0, of_truth(r.holdout), of_truth(r.sensed_holdout), of_given, r.wall_s);
}

}  // namespace

std::string trials_csv(const Results& all) {
  std::string text =
      "kind,sensors,off,index,seed,arm,joints,joint_rate_hz,latency_s,failure,truth,seen_from,named_from,verdict,named,"
      "probabilities,alternatives,unexplained,probability_clean,probability_none,strictly_right,loosely_right,"
      "error_over_true_model,error_over_true_model_as_sensed,error_over_given,wall_s\n";
  for (const Result* r : all) text += line_of(*r);
  return text;
}

}  // namespace halyard::blind
