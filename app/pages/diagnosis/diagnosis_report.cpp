#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "app/pages/diagnosis/diagnosis_output.h"
#include "app/pages/diagnosis/rehearsal_output.h"
#include "app/pages/diagnosis/view_charts.h"
#include "diagnosis/diagnosis_details.h"
#include "diagnosis/explanation/estimates.h"
#include "diagnosis/explanation/view_sentence.h"
#include "evaluation/joint_unit.h"
#include "evaluation/studies/diagnosis_evidence.h"
#include "model/output/number_text.h"

namespace halyard {
namespace {

/// Digits of a number and the ends of its interval: as many as it takes to tell the ends apart, and at least four.
int digits_of(const Estimated& p) {
  int digits = 4;
  while (digits < 9 && p.lower < p.upper &&
         rounded_to_digits(p.upper, digits) - rounded_to_digits(p.lower, digits) < 0.9 * (p.upper - p.lower))
    ++digits;
  return digits;
}

std::string number(double value, const Estimated& p) { return fmt::format("{:.{}g}", value, digits_of(p)); }

std::string interval(const Estimated& p) { return p.is_whole ? "-" : number(p.lower, p) + " to " + number(p.upper, p); }

/// Effects of the revised model with how the page calls them: those with a name, then those whose name is a guess.
std::vector<std::pair<std::string, const NamedEffect*>> effects_with_labels(const Diagnosis& d) {
  std::vector<std::pair<std::string, const NamedEffect*>> all;
  for (const NamedEffect& e : d.effects) all.emplace_back(label_of(e), &e);
  for (const Unexplained& u : d.unexplained)
    if (u.effect) all.emplace_back(label_of(*u.effect) + " (its name is a guess)", &*u.effect);
  return all;
}

void add_numbers(report::Page& page, const Diagnosis& d) {
  if (const auto effects = effects_with_labels(d); !effects.empty()) {
    report::Table table;
    table.caption =
        "Parameters of the effects that were added. A size that is not significant, or ends at what is plausible, has "
        "its neutral value: 0, or 1 of a ratio.";
    table.header = {"effect", "parameter", "value", "95 % interval", "unit"};
    table.align = {report::Align::left, report::Align::left, report::Align::right, report::Align::right,
                   report::Align::left};
    for (const auto& [label, effect] : effects)
      for (const Estimated& p : effect->parameters)
        table.rows.push_back({label, p.name, number(p.value, p), interval(p), p.unit});
    page.table(table);
  }
  if (!d.refitted.empty()) {
    report::Table table;
    table.caption = fmt::format("Numbers of the model that were refitted within {}; they do not count as effects",
                                d.tolerance_factor > 1 ? fmt::format("{:g} times its tolerances", d.tolerance_factor)
                                                       : std::string("its tolerances"));
    table.header = {"number", "model", "refitted", "95 % interval", "unit"};
    table.align = {report::Align::left, report::Align::right, report::Align::right, report::Align::right,
                   report::Align::left};
    for (const Estimated& p : d.refitted)
      table.rows.push_back({p.name, number(p.nominal, p), number(p.value, p), interval(p), p.unit});
    page.table(table);
  }
  for (const std::string& line : bound_lines(d)) page.paragraph(capitalised(line) + ".");
}

/// What a chart draws of one joint: a value of each sample, NaN where there is none, over another value.
using Value = std::function<double(const Record&, const FullPrediction&, std::size_t)>;

report::Series drawn(const char* name, const std::vector<Record>& records,
                     const std::vector<FullPrediction>& predictions, const Value& x, const Value& y) {
  report::Series s;
  s.name = name;
  for (std::size_t r = 0; r < records.size(); ++r)
    for (std::size_t i = 0; i < records[r].size; ++i) {
      const double value = y(records[r], predictions[r], i);
      if (std::isnan(value)) continue;
      s.x.push_back(x(records[r], predictions[r], i));
      s.y.push_back(value);
    }
  return s;
}

report::Chart before_and_after(const std::string& title, const HoldOut& view, const Value& x, const Value& y) {
  report::Chart chart;
  chart.title = title;
  chart.series = {drawn("before", view.records, view.before, x, y), drawn("after", view.records, view.after, x, y)};
  return chart;
}

void add_residuals(report::Page& page, const Diagnosis& d) {
  for (int k = 0; k < d.revised.n(); ++k)
    if (const auto charts = residual_charts(d, k); !charts.empty()) page.figure_row(charts);
}

/// What a filter's next reading said that the filter had not expected, of each motor.
void add_innovations(report::Page& page, const ArmModel& model, const DiagnosisEvaluation& evaluation) {
  const auto filter = std::ranges::find(evaluation.estimators, "ekf", &EstimatorComparison::name);
  if (filter == evaluation.estimators.end() || filter->before.time.empty() || filter->after.time.empty()) return;
  const std::vector<JointUnit> units = joint_units(model);
  page.heading("Innovations on the hold-out");
  page.paragraph(
      "Each motor's reading less what ekf had predicted of it, over the deviation that it had predicted: 95 % lie "
      "within 2 and nothing is left to see if the model is right.");
  for (int k = 0; k < model.n(); ++k) {
    const auto chart = [&](const std::string& over, const std::string& x_label, report::ChartKind kind,
                           const auto& x_of) {
      report::Chart c{.title = fmt::format("Motor {}: innovation over {}", k + 1, over),
                      .x_label = x_label,
                      .y_label = "innovation [its deviations]",
                      .kind = kind};
      for (const bool after : {false, true}) {
        const EstimatorErrors& e = after ? filter->after : filter->before;
        report::Series s{.name = after ? "revised model" : "given model"};
        for (std::size_t i = 0; i < e.time.size(); ++i)
          if (std::isfinite(e.innovation[k][i])) s.x.push_back(x_of(e, i)), s.y.push_back(e.innovation[k][i]);
        c.series.push_back(std::move(s));
      }
      return c;
    };
    const double scale = units[k].shown_per_si;
    std::vector<report::Chart> row = {
        chart("time", "time [s]", report::ChartKind::line,
              [](const EstimatorErrors& e, std::size_t i) { return e.time[i]; }),
        chart("the joint's rate", "joint rate [" + units[k].shown + "/s]", report::ChartKind::scatter,
              [&](const EstimatorErrors& e, std::size_t i) { return scale * e.joint_rate[k][i]; })};
    if (!row[0].series[0].x.empty()) page.figure_row(std::move(row));
  }
}

void add_evidence(report::Page& page, const Diagnosis& d, const DiagnosisEvaluation& evaluation) {
  if (!evaluation.evidence) return;
  const auto& [effects, unexplained] = *evaluation.evidence;
  if (effects.empty() && unexplained.empty()) return;
  page.heading("What the residuals show");
  page.paragraph(
      "A residual is the measured value minus the predicted one, on the training data. Each chart shows a residual "
      "against the signal that explains most of it: predicted by the revised model without one effect, and with it. "
      "The shares that are stated are those above what chance would give.");
  const auto add = [&](const std::string& text, const EffectEvidence& evidence, bool is_rest) {
    page.paragraph(text);
    if (const auto charts = view_charts(evidence, d.revised.nominal, is_rest); !charts.empty()) page.figure_row(charts);
  };
  for (std::size_t i = 0; i < effects.size(); ++i)
    add(capitalised(effect_label(d.effects[i].effect)) + ": " + evaluation.why[i], effects[i], false);
  for (std::size_t i = 0; i < unexplained.size(); ++i)
    add(fmt::format("Left unexplained at joint {}: {}.", d.unexplained[i].joint + 1, d.unexplained[i].signature),
        unexplained[i], true);
}

std::string outcome_of(const Round& round) {
  if (round.tolerance_factor) {
    std::string text = fmt::format("the model's tolerances count {:g} times", *round.tolerance_factor);
    for (const PlacedEffect& e : round.gone) text += ", without " + effect_label(e);
    return text;
  }
  if (round.at_once)
    return round.accepted ? "several candidates were added at once" : "several candidates at once were not convincing";
  if (!round.revised) return round.accepted ? "the first candidate was added" : "no candidate was convincing";
  return fmt::format("revision of {}: {}", effect_label(*round.revised),
                     round.accepted     ? "the first candidate was fitted in its place"
                     : round.name_stays ? "it stays as it was"
                                        : "no candidate was convincing, and it is not needed any more");
}

/// What became of a candidate. is_taken: it was added.
std::string fate_of(const Trial& t, const Round& round, bool is_taken) {
  if (!t.promising) return "takes nothing of the residual";
  if (!t.is_fitted) return "leaves more of the residual than those that were fitted";
  if (!t.usable) return "cannot be integrated";
  if (is_taken) return "added";
  if (round.revised && same_name(t.effect, *round.revised)) return round.name_stays ? "stays" : "the name before";
  if (t.gain <= 0) return "does not help on data that the fit did not see";
  if (!t.is_judged()) return "not significant";
  if (t.at_bound) return "fits best with a size that is not plausible";
  if (t.is_another) return "is needed only for what another effect explains, too";
  if (t.is_refit) return "within the tolerance of the model's numbers";
  if (!t.matters) return "too small to matter";
  if (round.accepted) return "less probable than the first";
  return round.name_stays ? "less probable than the name" : "not significant";
}

void add_candidates(report::Page& page, const Diagnosis& d) {
  for (std::size_t r = 0; r < d.details->attribution.rounds.size(); ++r) {
    const Round& round = d.details->attribution.rounds[r];
    report::Table table;
    table.caption = fmt::format("Round {}: {}", r + 1, outcome_of(round));
    if (round.tolerance_factor) {
      page.paragraph(table.caption + ".");
      continue;
    }
    table.header = {"candidate", "gain [nats]", "p", "verdict"};
    table.align = {report::Align::left, report::Align::right, report::Align::right, report::Align::left};
    constexpr std::size_t kShown = 8;
    if (round.trials.size() > kShown)
      table.caption += fmt::format(". The first {} of {} candidates", kShown, round.trials.size());
    for (std::size_t i = 0; i < std::min(kShown, round.trials.size()); ++i) {
      const Trial& t = round.trials[i];
      const bool taken = round.accepted && (round.at_once || &t == &round.trials.front());
      table.rows.push_back({{effect_label(t.effect), taken},
                            t.usable ? fmt::format("{:.1f}", t.gain) : std::string("-"),
                            t.usable && t.gain > 0 ? fmt::format("{:.2g}", t.p_value) : std::string("-"),
                            fate_of(t, round, taken)});
    }
    page.table(table);
  }
}

}  // namespace

std::vector<report::Chart> residual_charts(const Diagnosis& d, int k) {
  const JointUnit unit = joint_units(d.revised)[k];
  const double scale = unit.shown_per_si;
  const ShownUnit torque_unit = residual_unit(d.revised.nominal, k, ResidualKind::motor_torque);
  const std::string torque_name = residual_name(d.revised.nominal, k, ResidualKind::motor_torque);
  const Value time = [](const Record& r, const FullPrediction&, std::size_t i) { return r.time(i); };
  const Value rate = [k](const Record& r, const FullPrediction&, std::size_t i) { return r.motor_rate[k][i]; };
  const Value joint = [=](const Record& r, const FullPrediction& p, std::size_t i) {
    return scale * joint_error(r, p, k, i);
  };
  const Value torque = [=](const Record& r, const FullPrediction& p, std::size_t i) {
    return torque_unit.per_si * torque_error(r, p, k, i);
  };
  std::vector<report::Chart> charts;
  const auto add = [&](report::Chart chart, const std::string& x, const std::string& y, report::ChartKind kind) {
    chart.x_label = x;
    chart.y_label = y;
    chart.kind = kind;
    charts.push_back(std::move(chart));
  };
  const std::string joint_label = "measured - predicted [" + unit.shown + "]",
                    torque_label = "residual [" + torque_unit.name + "]";
  const std::string rate_label =
      "motor rate [" + abscissa_unit(d.revised.nominal, k, ResidualKind::motor_torque, Abscissa::rate).name + "]";
  const bool has_joint = std::isfinite(d.before.joint_rms[k]), has_torque = std::isfinite(d.before.torque_rms[k]);
  if (has_joint)
    add(before_and_after(fmt::format("Joint {}: position error", k + 1), d.details->joint_view, time, joint),
        "time [s]", joint_label, report::ChartKind::line);
  if (has_torque)
    add(before_and_after(fmt::format("Joint {}: {}", k + 1, torque_name), d.details->torque_view, time, torque),
        "time [s]", torque_label, report::ChartKind::line);
  if (has_joint)
    add(before_and_after(fmt::format("Joint {}: error over motor rate", k + 1), d.details->joint_view, rate, joint),
        rate_label, joint_label, report::ChartKind::scatter);
  else if (has_torque)
    add(before_and_after(fmt::format("Joint {}: {} over motor rate", k + 1, torque_name), d.details->torque_view, rate,
                         torque),
        rate_label, torque_label, report::ChartKind::scatter);
  return charts;
}

report::Chart interval_chart(const Diagnosis& d, int k) {
  const JointUnit unit = joint_units(d.revised)[k];
  const HoldOut& view = d.details->joint_view;
  report::Series error{.name = "after", .colour = 1};
  report::Series upper{.name = "95 % interval", .dashed = true, .colour = 0}, lower = upper;
  lower.name = "";
  for (std::size_t r = 0; r < view.records.size(); ++r)
    for (std::size_t i = 0; i < view.records[r].size; ++i) {
      const double e = joint_error(view.records[r], view.after[r], k, i);
      if (std::isnan(e)) continue;
      for (report::Series* s : {&error, &upper, &lower}) s->x.push_back(view.records[r].time(i));
      const double half = unit.shown_per_si * view.half_width[r][k][i];
      error.y.push_back(unit.shown_per_si * e);
      upper.y.push_back(half);
      lower.y.push_back(-half);
    }
  return {.title = fmt::format("Joint {}: position error and interval", k + 1),
          .x_label = "time [s]",
          .y_label = "measured - predicted [" + unit.shown + "]",
          .series = {std::move(error), std::move(upper), std::move(lower)}};
}

report::Page diagnosis_page(const ArmModel& model, const Diagnosis& d, const DiagnosisEvaluation& evaluation) {
  report::Page page("Diagnosis of " + model.name, "What the model lacks, by measured data");
  add_verdict(page, d, evaluation);
  add_log_findings(page, d);
  add_error_table(page, d);
  page.paragraph(
      "Joint position is predicted from motor signals alone: the arm is driven by the measured motor motion and its "
      "joints follow through the cables. Torque is predicted from the same motion and low-pass filtered like it.");
  add_error_parts(page, d);
  add_intervals(page, d);
  add_estimator_errors(page, model, evaluation);
  add_evidence(page, d, evaluation);
  add_numbers(page, d);
  if (evaluation.rehearsals) add_rehearsals(page, d, *evaluation.rehearsals);
  page.heading("Residuals on the hold-out");
  add_residuals(page, d);
  add_innovations(page, model, evaluation);
  page.heading("How the candidates fared");
  page.paragraph(
      "Each candidate is fitted together with the model's own numbers, kept within their tolerance, on every other "
      "block of the training data; the gain in log-likelihood is counted on the blocks between, and p is the "
      "probability of such a gain if there were none: by a paired t test over blocks, or by the likelihood ratio of a "
      "candidate that explains nearly all of a residual.");
  add_candidates(page, d);
  if (!d.not_excited.empty()) {
    std::string text = "Effects that these data could not show at their typical size: ";
    for (std::size_t i = 0; i < d.not_excited.size(); ++i)
      text += (i ? ", " : "") + d.not_excited[i].effect +
              (d.not_excited[i].joint ? fmt::format(" of joint {}", *d.not_excited[i].joint + 1) : "");
    page.paragraph(text + ".");
  }
  return page;
}

}  // namespace halyard
