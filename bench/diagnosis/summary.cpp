#include "bench/diagnosis/summary.h"

#include <cmath>
#include <functional>
#include <set>

#include "bench/diagnosis/proportion.h"
#include "diagnosis/search_space.h"
#include "model/output_file.h"
#include "transmission/effect.h"

namespace halyard::blind {
namespace {

using Results = std::vector<const Result*>;
using Test = std::function<bool(const Result&)>;

constexpr const char* kShareHead = "count | share | 95 % interval";
constexpr const char* kShareRule = "---:|---:|---";

Proportion share(const Results& all, const Test& hit) {
  Proportion s;
  for (const Result* r : all) s.count(hit(*r));
  return s;
}

/// All effects of the truth are stronger than the limit.
bool is_strong(const Result& r, double limit) {
  return std::ranges::all_of(r.truth, [&](const TrueEffect& t) { return t.strength >= limit; });
}

bool names_something(const Result& r) { return !r.named.empty(); }

/// Effects in the library's order; then what else was hidden, by name.
std::vector<std::string> names_of(const Results& results, const std::function<std::string(const Result&)>& name) {
  std::set<std::string> met;
  for (const Result* r : results) met.insert(name(*r));
  std::vector<std::string> all;
  for (const Effect* e : effect_library())
    if (met.erase(e->name())) all.push_back(e->name());
  all.insert(all.end(), met.begin(), met.end());
  return all;
}
std::string right_name(const Result& r) { return r.truth[0].place.effect; }
std::string acting_name(const Result& r) { return r.truth[0].form.empty() ? right_name(r) : r.truth[0].form; }

Results those(const Results& all, const Test& wanted) {
  Results some;
  std::ranges::copy_if(all, std::back_inserter(some), [&](const Result* r) { return wanted(*r); });
  return some;
}

Proportion least_often(const Results& trials) {
  Proportion least;
  for (const std::string& name : names_of(trials, right_name)) {
    const Proportion s = share(those(trials, [&](const Result& r) { return right_name(r) == name; }), right_first);
    if (least.of == 0 || s.value() < least.value()) least = s;
  }
  return least;
}

/// The smallest x above which at least 90 % of the trials are right; infinite if there is none.
double detection_limit(const Results& trials, const std::function<double(const Result&)>& x) {
  constexpr double kShare = 0.9;
  constexpr int kFewest = 5;
  Results sorted = trials;
  std::ranges::stable_sort(sorted, [&](const Result* a, const Result* b) { return x(*a) > x(*b); });
  double limit = std::numeric_limits<double>::infinity();
  Proportion s;
  for (const Result* r : sorted) {
    s.count(right_first(*r));
    if (s.of >= kFewest && s.value() >= kShare) limit = x(*r);
  }
  return limit;
}

double strength(const Result& r) { return r.truth[0].strength; }
double size(const Result& r) { return r.truth[0].size; }

std::string limit_text(double x) { return std::isfinite(x) ? fmt::format("{:.2g}", x) : "not reached"; }

/// One line an effect: right first, right or alternative, by the name that acts.
std::string effect_table(const Results& trials, double limit) {
  std::string text = fmt::format("| truth | {} | or among two alternatives | median strength |\n|---|{}|---:|---:|\n",
                                 kShareHead, kShareRule);
  const auto line = [&](const std::string& name, const Results& some) {
    std::vector<double> strengths;
    for (const Result* r : some) strengths.push_back(strength(*r));
    const Proportion alternative = share(some, right_or_alternative);
    text += fmt::format("| {} | {} | {}/{} | {:.3g} |\n", name, share(some, right_first).cells(), alternative.hits,
                        alternative.of, median(strengths));
  };
  const Results strong = those(trials, [&](const Result& r) { return is_strong(r, limit); });
  for (const std::string& name : names_of(strong, acting_name)) {
    const Results some = those(strong, [&](const Result& r) { return acting_name(r) == name; });
    line(acting_name(*some[0]) == right_name(*some[0]) ? name : name + " (" + right_name(*some[0]) + ")", some);
  }
  line("**all**", strong);
  return text + "\n";
}

/// What was named first, of each truth; right effects at a wrong joint stand apart.
std::vector<std::vector<std::string>> confusion(const Results& trials) {
  const auto first = [](const Result& r) {
    const bool joint_only =
        !r.truth.empty() && !r.named.empty() && !right_first(r) && r.named[0].place.effect == right_name(r);
    return joint_only           ? std::string("other joint")
           : !r.failure.empty() ? "failed"
           : r.named.empty()    ? r.verdict
                                : r.named[0].place.effect;
  };
  const auto truth = [](const Result& r) { return r.truth.empty() ? std::string("clean") : right_name(r); };
  std::vector<std::vector<std::string>> table = {{"truth \\ named first"}};
  const std::vector<std::string> columns = names_of(trials, first);
  table[0].insert(table[0].end(), columns.begin(), columns.end());
  for (const std::string& row : names_of(trials, truth)) {
    table.push_back({row});
    for (const std::string& column : columns) {
      const int n = share(trials, [&](const Result& r) { return truth(r) == row && first(r) == column; }).hits;
      table.back().push_back(n == 0 ? "" : std::to_string(n));
    }
  }
  return table;
}

std::string markdown(const std::vector<std::vector<std::string>>& table) {
  std::string text;
  for (std::size_t i = 0; i < table.size(); ++i) {
    text += fmt::format("| {} |\n", fmt::join(table[i], " | "));
    if (i == 0)
      text += "|---" + [&] {
        std::string rule;
        for (std::size_t c = 1; c < table[0].size(); ++c) rule += "|---:";
        return rule;
      }() + "|\n";
  }
  return text + "\n";
}

/// Error of the revised model over that of the truth, joint by joint: the worst joint, and the geometric mean.
std::pair<double, double> error_ratio(const Result& r) {
  double worst = 0, sum = 0;
  for (std::size_t k = 0; k < r.after.size(); ++k) {
    const double ratio = r.after[k] / r.true_model[k];
    worst = std::max(worst, ratio);
    sum += std::log(ratio);
  }
  return {worst, std::exp(sum / static_cast<double>(r.after.size()))};
}

/// Intervals of the effects that were named rightly, over their true parameters.
Proportion coverage(const Results& trials) {
  Proportion s;
  for (const Result* r : trials)
    for (const TrueEffect& t : r->truth)
      for (const Named& n : r->named)
        for (const Parameter& p : n.parameters)
          for (const TrueParameter& truth : t.parameters)
            if (n.place == t.place && p.name == truth.name && truth.acts)
              s.count(p.lower <= truth.value && truth.value <= p.upper);
  return s;
}

std::string trials_csv(const Results& all) {
  std::string text =
      "kind,index,seed,failure,truth,form,size,strength,truth_2,strength_2,verdict,named_first,alternatives,named_"
      "others,unexplained,"
      "right,right_or_alternative,error_ratio_worst,error_ratio_mean,wall_s,cpu_s\n";
  for (const Result* r : all) {
    const auto truth = [&](std::size_t i) { return i < r->truth.size() ? label(r->truth[i].place) : std::string(); };
    const auto strength_of = [&](std::size_t i) {
      return i < r->truth.size() ? fmt::format("{:.4g}", r->truth[i].strength) : std::string();
    };
    std::vector<std::string> alternatives, others;
    for (std::size_t i = 0; i < r->named.size(); ++i) {
      if (i > 0) others.push_back(label(r->named[i].place));
      for (const Place& a : r->named[i].alternatives)
        if (i == 0) alternatives.push_back(label(a));
    }
    std::string failure = r->failure;
    std::ranges::replace_if(
        failure, [](char c) { return c == ',' || c == '\n'; }, ';');
    const auto [worst, mean] = error_ratio(*r);
    text += fmt::format("{},{},{},{},{},{},{:.4g},{},{},{},{},{},{},{},{},{},{},{:.4g},{:.4g},{:.2f},{:.2f}\n",
                        word(r->kind), r->index, r->seed, failure, truth(0), r->truth.empty() ? "" : r->truth[0].form,
                        r->truth.empty() ? 0 : r->truth[0].size, strength_of(0), truth(1), strength_of(1), r->verdict,
                        r->named.empty() ? "" : label(r->named[0].place), fmt::join(alternatives, "; "),
                        fmt::join(others, "; "), fmt::join(r->unexplained, "; "), is_right(*r) ? 1 : 0,
                        right_or_alternative(*r) ? 1 : 0, worst, mean, r->wall_s, r->cpu_s);
  }
  return text;
}

std::string effects_csv(const Results& effect, double limit) {
  std::string text =
      "effect,strong_trials,right_first,lower,upper,right_or_alternative,detection_strength,detection_size\n";
  for (const std::string& name : names_of(effect, right_name)) {
    const Results some = those(effect, [&](const Result& r) { return right_name(r) == name; });
    const Results strong = those(some, [&](const Result& r) { return is_strong(r, limit); });
    const Proportion s = share(strong, right_first);
    text += fmt::format("{},{},{},{:.4f},{:.4f},{},{},{}\n", name, s.of, s.hits, s.lower(), s.upper(),
                        share(strong, right_or_alternative).hits, limit_text(detection_limit(some, strength)),
                        limit_text(detection_limit(some, size)));
  }
  return text;
}

/// Detection limits in the effects' own units: changes from neutral.
std::string detection_csv(const Results& effect, const ArmParameters<double>& arm) {
  std::string text = "effect,joint,parameter,unit,typical_change,detection_change\n";
  for (const std::string& name : names_of(effect, right_name)) {
    const Effect* e = find_effect(name);
    if (!e) continue;  // results of a build with other effects
    const double limit = detection_limit(those(effect, [&](const Result& r) { return right_name(r) == name; }), size);
    for (const EffectPlace joint : effect_places(*e, arm)) {
      const std::vector<EffectParameter> parameters = e->parameters(arm, joint);
      const SearchSpace space = search_space(*e, arm, joint);
      for (std::size_t i = 0; i < parameters.size(); ++i) {
        const EffectParameter& p = parameters[i];
        if (space.parameters[i].range != SearchRange::own || p.is_shape()) continue;
        const double typical = std::abs(p.typical - p.neutral);
        text += fmt::format("{},{},{},{},{:.4g},{}\n", name, joint ? *joint + 1 : 0, p.name, p.unit, typical,
                            limit_text(limit * typical));
      }
    }
  }
  return text;
}

std::string detection_table(const Results& effect) {
  std::string text =
      "| effect | trials | strength | in typical sizes | weaker trials that it named all the same "
      "|\n|---|---:|---:|---:|---:|\n";
  for (const std::string& name : names_of(effect, right_name)) {
    const Results some = those(effect, [&](const Result& r) { return right_name(r) == name; });
    const double limit = detection_limit(some, strength);
    const Proportion weaker = share(those(some, [&](const Result& r) { return strength(r) < limit; }), right_first);
    text += fmt::format("| {} | {} | {} | {} | {}/{} |\n", name, some.size(), limit_text(limit),
                        limit_text(detection_limit(some, size)), weaker.hits, weaker.of);
  }
  return text + "\n";
}

/// The trials by kind.
struct Trials {
  Results all;
  Results ran;  ///< a diagnosis that fails is a wrong answer; a trial that could not be drawn is none
  double limit;

  Results of(Kind kind) const {
    return those(ran, [&](const Result& r) { return r.kind == kind; });
  }
  Results strong(Kind kind) const {
    return those(of(kind), [&](const Result& r) { return is_strong(r, limit); });
  }
};

Trials sort_out(const std::vector<Result>& results, double limit) {
  Trials trials{.all = {}, .ran = {}, .limit = limit};
  for (const Result& r : results) trials.all.push_back(&r);
  trials.ran =
      those(trials.all, [](const Result& r) { return r.failure.empty() || r.failure.starts_with("diagnose"); });
  return trials;
}

std::string section(const std::string& title, const std::string& text) { return "## " + title + "\n\n" + text; }

std::string head(const Trials& t) {
  return fmt::format(
      "# Blind trials of the diagnosis\n\n{} trials; {} could not be drawn, in {} the diagnosis failed. An effect "
      "counts from strength {:g} on: what it changes beyond the model's tolerances and constant errors of the sensors, "
      "over what the sensors resolve.\n\n",
      t.all.size(), t.all.size() - t.ran.size(), share(t.ran, [](const Result& r) { return !r.failure.empty(); }).hits,
      t.limit);
}

bool names_one_of_them(const Result& r) {
  return std::ranges::any_of(r.truth, [&](const TrueEffect& t) {
    return std::ranges::find(r.named, t.place, &Named::place) != r.named.end();
  });
}

constexpr Kind kCleanKinds[] = {Kind::clean_exact, Kind::clean_mistuned};
constexpr Kind kEffectKinds[] = {Kind::effect, Kind::each_effect, Kind::effect_mistuned};

std::string question_table(const Trials& t) {
  std::string text = fmt::format("| question | bar | {} |\n|---|---|{}|\n", kShareHead, kShareRule);
  const auto question = [&](const std::string& what, const std::string& bar, const Proportion& s) {
    text += fmt::format("| {} | {} | {} |\n", what, bar, s.cells());
  };
  for (const Kind kind : kCleanKinds)
    question(word(kind) + ": an effect is named", "0", share(t.of(kind), names_something));
  for (const Kind kind : kCleanKinds)
    question(word(kind) + ": verdict unknown", "",
             share(t.of(kind), [](const Result& r) { return r.verdict == "unknown"; }));
  for (const Kind kind : kEffectKinds) {
    const Results strong = t.strong(kind);
    question(word(kind) + ": effect and joint right, first", "90 %", share(strong, right_first));
    question(word(kind) + ": right, or among at most two alternatives", "97 %", share(strong, right_or_alternative));
    question(word(kind) + ": right, and nothing else named", "",
             share(strong, [](const Result& r) { return right_first(r) && r.named.size() == 1; }));
    question(word(kind) + ": the effect found least often", "70 %", least_often(strong));
  }
  question("form: effect and joint right, first", "", share(t.strong(Kind::form), right_first));
  question("form: right, or among at most two alternatives", "", share(t.strong(Kind::form), right_or_alternative));
  question("outside: unknown, or named with an unexplained residual", "90 %",
           share(t.strong(Kind::outside), admits_rest));
  question("pair: both named", "75 %", share(t.strong(Kind::pair), all_named));
  question("pair: one or both named", "", share(t.strong(Kind::pair), names_one_of_them));
  for (const Kind kind : kEffectKinds)
    question("a true parameter lies in its 95 % interval (" + word(kind) + ")", "", coverage(t.of(kind)));
  return text + "\n";
}

std::string outside_table(const Results& trials) {
  std::string table = fmt::format("| truth | unknown, or an unexplained residual: {} | clean |\n|---|{}|---:|\n",
                                  kShareHead, kShareRule);
  for (const std::string& name : names_of(trials, right_name)) {
    const Results some = those(trials, [&](const Result& r) { return right_name(r) == name; });
    table += fmt::format("| {} | {} | {} |\n", name, share(some, admits_rest).cells(),
                         share(some, [](const Result& r) { return r.verdict == "clean"; }).hits);
  }
  return table + "\n";
}

/// Effects above the limit and clean arms: those that the confusion matrix counts.
Results strong_or_clean(const Trials& t) {
  Results some = t.strong(Kind::effect);
  for (const Kind kind : {Kind::each_effect, Kind::effect_mistuned, Kind::clean_exact, Kind::clean_mistuned})
    std::ranges::copy(t.strong(kind), std::back_inserter(some));
  return some;
}

std::string ratio_table(const Trials& t) {
  std::string text =
      "Joint position RMS after, over that of the true model, on the hold-out; bar: a median of 1.15.\n\n"
      "| kind | trials | worst joint: median | 90 % below | mean of the joints: median | 90 % below "
      "|\n|---|---:|---:|---:|---:|---:|\n";
  for (const Kind kind :
       {Kind::clean_exact, Kind::clean_mistuned, Kind::effect, Kind::each_effect, Kind::effect_mistuned, Kind::pair}) {
    std::vector<double> worst, mean;
    for (const Result* r : t.strong(kind))
      if (r->failure.empty()) worst.push_back(error_ratio(*r).first), mean.push_back(error_ratio(*r).second);
    if (!worst.empty())
      text += fmt::format("| {} | {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} |\n", word(kind), worst.size(), median(worst),
                          quantile(worst, 0.9), median(mean), quantile(mean, 0.9));
  }
  return text + "\n";
}

std::string time_sentence(const Results& ran) {
  std::vector<double> cpu;
  for (const Result* r : ran)
    if (r->failure.empty()) cpu.push_back(r->cpu_s);
  return fmt::format("A diagnosis takes {:.1f} s of one processor in the median, {:.1f} s at most.\n", median(cpu),
                     quantile(cpu, 1));
}

std::string summary(const Trials& t) {
  std::string text = head(t) + question_table(t);
  for (const Kind kind : {Kind::effect, Kind::each_effect, Kind::effect_mistuned, Kind::form})
    if (!t.strong(kind).empty())
      text += section("Named first, by truth: " + word(kind), effect_table(t.of(kind), t.limit));
  const Results outside = t.strong(Kind::outside), form = t.strong(Kind::form), effect = t.of(Kind::effect);
  if (!outside.empty()) text += section("Effects outside the library", outside_table(outside));
  if (!effect.empty()) text += section("Detection limits: above, 90 % name the effect first", detection_table(effect));
  text += section("Confusion: clean and effects above the limit", markdown(confusion(strong_or_clean(t))));
  if (!form.empty()) text += section("Confusion: other functional forms", markdown(confusion(form)));
  if (!outside.empty()) text += section("Confusion: outside the library", markdown(confusion(outside)));
  text += section("Error on the hold-out", ratio_table(t));
  return text + section("Time", time_sentence(t.ran));
}

}  // namespace

void write_summary(const std::filesystem::path& out, const std::vector<Result>& results,
                   const ArmParameters<double>& arm, double limit) {
  const Trials trials = sort_out(results, limit);
  const Results effect = trials.of(Kind::effect);
  std::string csv;
  for (const auto& row : confusion(strong_or_clean(trials))) csv += fmt::format("{}\n", fmt::join(row, ","));
  write_file_whole(out / "confusion.csv", csv);
  write_file_whole(out / "effects.csv", effects_csv(effect, limit));
  write_file_whole(out / "detection.csv", detection_csv(effect, arm));
  write_file_whole(out / "trials.csv", trials_csv(trials.all));
  write_file_whole(out / "summary.md", summary(trials));
}

}  // namespace halyard::blind
