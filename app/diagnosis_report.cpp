#include <fmt/format.h>

#include <cmath>

#include "app/diagnosis_output.h"
#include "app/joint_unit.h"

namespace halyard {
namespace {

std::string interval(const Estimated& p) {
  return fmt::format("{:.4g} to {:.4g}", p.lower, p.upper);
}

void add_numbers(report::Page& page, const Diagnosis& d) {
  if (!d.effects.empty()) {
    report::Table table;
    table.caption = "Parameters of the effects that were added";
    table.header = {"effect", "parameter", "value", "95 % interval", "unit"};
    table.align = {report::Align::left, report::Align::left, report::Align::right, report::Align::right, report::Align::left};
    for (const NamedEffect& e : d.effects)
      for (const Estimated& p : e.parameters)
        table.rows.push_back({effect_label(e.effect), p.name, fmt::format("{:.4g}", p.value), interval(p), p.unit});
    page.table(table);
  }
  if (!d.refitted.empty()) {
    report::Table table;
    table.caption = "Numbers of the model that were refitted within its tolerance: no effects";
    table.header = {"number", "model", "refitted", "95 % interval", "unit"};
    table.align = {report::Align::left, report::Align::right, report::Align::right, report::Align::right, report::Align::left};
    for (const Estimated& p : d.refitted)
      table.rows.push_back({p.name, fmt::format("{:.5g}", p.nominal), fmt::format("{:.5g}", p.value), interval(p), p.unit});
    page.table(table);
  }
}

/// Residuals over time, before and after, and the one view over which the effect shows as a loop.
void add_residuals(report::Page& page, const Diagnosis& d) {
  const std::vector<JointUnit> units = joint_units(d.revised);
  for (int k = 0; k < d.revised.n(); ++k) {
    report::Chart joint, torque, loop;
    joint.title = fmt::format("Joint {}: position error on the hold-out", k + 1);
    joint.x_label = "time [s]";
    joint.y_label = "measured - predicted [" + units[k].shown + "]";
    torque.title = fmt::format("Joint {}: motor torque residual", k + 1);
    torque.x_label = "time [s]";
    torque.y_label = "residual [mN m]";
    loop.title = fmt::format("Joint {}: residual over motor rate", k + 1);
    loop.x_label = "motor rate [rad/s]";
    loop.kind = report::ChartKind::scatter;
    const auto series = [](const char* name) {
      report::Series s;
      s.name = name;
      return s;
    };
    report::Series before[3] = {series("before"), series("before"), series("before")};
    report::Series after[3] = {series("after"), series("after"), series("after")};
    bool has_joint = false, has_torque = false;
    for (std::size_t r = 0; r < d.holdout_records.size(); ++r) {
      const Record& record = d.holdout_records[r];
      has_joint = has_joint || record.has_joint(k);
      has_torque = has_torque || record.has_torque(k);
      for (std::size_t i = 0; i < record.size; ++i) {
        const double t = record.time(i);
        if (record.has_joint(k) && record.joint_valid[k][i] > 0) {
          const double scale = units[k].shown_per_si;
          const double e0 = scale * (record.joint_raw[k][i] - d.holdout_before[r].joint_reading[k][i]);
          const double e1 = scale * (record.joint_raw[k][i] - d.holdout_after[r].joint_reading[k][i]);
          before[0].x.push_back(t), before[0].y.push_back(e0);
          after[0].x.push_back(t), after[0].y.push_back(e1);
          before[2].x.push_back(record.motor_rate[k][i]), before[2].y.push_back(e0);
          after[2].x.push_back(record.motor_rate[k][i]), after[2].y.push_back(e1);
        }
        if (record.has_torque(k) && record.torque_valid[k][i] > 0) {
          const double e0 = 1e3 * d.holdout_before[r].torque_residual[k][i], e1 = 1e3 * d.holdout_after[r].torque_residual[k][i];
          before[1].x.push_back(t), before[1].y.push_back(e0);
          after[1].x.push_back(t), after[1].y.push_back(e1);
          if (!record.has_joint(k)) {
            before[2].x.push_back(record.motor_rate[k][i]), before[2].y.push_back(e0);
            after[2].x.push_back(record.motor_rate[k][i]), after[2].y.push_back(e1);
          }
        }
      }
    }
    loop.y_label = has_joint ? joint.y_label : torque.y_label;
    joint.series = {before[0], after[0]};
    torque.series = {before[1], after[1]};
    loop.series = {before[2], after[2]};
    std::vector<report::Chart> row;
    if (has_joint) row.push_back(joint);
    if (has_torque) row.push_back(torque);
    row.push_back(loop);
    if (has_joint || has_torque) page.figure_row(row);
  }
}

void add_candidates(report::Page& page, const Diagnosis& d) {
  for (std::size_t r = 0; r < d.attribution.rounds.size(); ++r) {
    const Round& round = d.attribution.rounds[r];
    report::Table table;
    table.caption = fmt::format("Round {}: {}", r + 1,
                                round.accepted ? "the first candidate was added" : "no candidate was convincing");
    table.header = {"candidate", "gain [nats]", "p", "verdict"};
    table.align = {report::Align::left, report::Align::right, report::Align::right, report::Align::left};
    std::size_t shown = 0;
    for (const Trial& t : round.trials) {
      if (++shown > 8) break;
      const bool taken = round.accepted && &t == &round.trials.front();
      table.rows.push_back({{effect_label(t.effect), taken},
                            t.usable ? fmt::format("{:.1f}", t.gain) : std::string("-"),
                            t.usable ? fmt::format("{:.2g}", t.p_value) : std::string("-"),
                            !t.usable      ? "cannot be integrated"
                            : taken        ? "added"
                            : t.gain <= 0  ? "does not help on data that the fit did not see"
                            : t.at_bound   ? "ends at the end of what is plausible"
                            : !t.matters   ? "too small to matter"
                            : round.accepted ? "helps less than the first"
                                             : "not significant"});
    }
    page.table(table);
  }
}

}  // namespace

report::Page diagnosis_page(const ArmModel& model, const Diagnosis& d) {
  report::Page page("Diagnosis of " + model.name, "What the model lacks, by measured data");
  add_verdict(page, d);
  add_error_table(page, d);
  page.paragraph(
      "Joint position is predicted from motor signals alone: the arm is driven by the measured motor motion and its joints "
      "follow through the cables. Torque is predicted from the same motion and low-pass filtered like it.");
  add_numbers(page, d);
  page.heading("Residuals on the hold-out");
  add_residuals(page, d);
  page.heading("How the candidates fared");
  page.paragraph(
      "Each candidate is fitted together with the model's own numbers, kept within their tolerance, on every other block of "
      "the training data; the gain in log-likelihood is counted on the blocks between, and p is the probability of such a "
      "gain if there were none (paired t test over blocks).");
  add_candidates(page, d);
  if (!d.not_excited.empty()) {
    std::string text = "Effects that these data could not show at their typical size: ";
    for (std::size_t i = 0; i < d.not_excited.size(); ++i)
      text += (i ? ", " : "") + d.not_excited[i].effect +
              (d.not_excited[i].joint < 0 ? "" : fmt::format(" of joint {}", d.not_excited[i].joint + 1));
    page.paragraph(text + ".");
  }
  return page;
}

}  // namespace halyard
