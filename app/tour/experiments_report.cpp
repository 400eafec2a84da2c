#include "app/tour/experiments_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "app/pages/comparison_figures.h"
#include "app/pages/comparison_output.h"
#include "diagnosis/explanation/view_sentence.h"

namespace halyard {
namespace {

using report::Align;
using report::Cell;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
/// Of the palette of 8: beside the estimators' and the truth's.
constexpr std::size_t kDesiredColour = 6;

const Comparison& first(const std::vector<Experiment>& experiments) { return experiments.front().comparison; }

/// Of the paper's filter over its kinematics, by Table IV.
double published_gain(int k) { return 1 - published_errors()[1].error[k] / published_errors()[0].error[k]; }

std::string letter(const Experiment& experiment) { return experiment.name.substr(0, 1); }

std::string shown_size(const EffectParameter& parameter, double value) {
  const ShownUnit unit = parameter.unit == "m"     ? ShownUnit{"mm", 1e3}
                         : parameter.unit == "rad" ? ShownUnit{"deg", 180 / std::numbers::pi}
                         : parameter.unit == "1"   ? ShownUnit{"", 1}
                                                   : ShownUnit{parameter.unit, 1};
  return fmt::format("{} {:.5g}{}{}", parameter.name, unit.per_si * value, unit.name.empty() ? "" : " ", unit.name);
}

/// "joint 1: ratio 1.056; joint 2: ratio 1.056"
std::string sizes(const ArmModel& robot, const std::string& effect) {
  std::string text;
  for (const PlacedEffect& e : robot.effects) {
    if (e.effect->name() != effect) continue;
    text += text.empty() ? "" : "; ";
    if (e.joint) text += fmt::format("joint {}: ", *e.joint + 1);
    const auto parameters = e.effect->parameters(robot.nominal, e.joint);
    for (std::size_t i = 0; i < parameters.size(); ++i) text += (i ? ", " : "") + shown_size(parameters[i], e.p[i]);
  }
  return text;
}

/// What the robot has beyond the model.
report::Table robot_table(const std::vector<Experiment>& experiments) {
  report::Table table;
  table.caption = "What the simulated robot has and the estimators' model has not";
  table.header = {"effect", "is", "size", "experiments"};
  table.align.assign(table.header.size(), Align::left);
  std::vector<std::string> listed;
  for (const Experiment& experiment : experiments) {
    for (const PlacedEffect& e : experiment.robot.effects) {
      const std::string name = e.effect->name();
      if (std::ranges::find(listed, name) != listed.end()) continue;
      listed.push_back(name);
      std::string letters;
      for (const Experiment& other : experiments)
        if (!sizes(other.robot, name).empty())
          letters += fmt::format("{}{}", letters.empty() ? "" : ", ", letter(other));
      table.rows.push_back({name, e.effect->summary(), sizes(experiment.robot, name), letters});
    }
  }
  if (experiments.front().robot.nominal.joint[0].law == CableLaw::paper) return table;
  std::string tensions, letters;
  for (const Experiment& e : experiments) {
    const auto& joint = e.robot.nominal.joint;
    tensions += fmt::format("{}{}: {:g}, {:g}, {:g} N", tensions.empty() ? "" : "; ", letter(e), joint[0].tension,
                            joint[1].tension, joint[2].tension);
    letters += fmt::format("{}{}", letters.empty() ? "" : ", ", letter(e));
  }
  table.rows.push_back({kCableLaw, "a run of cable that has lost its tension is slack", tensions, letters});
  return table;
}

/// Which numbers of the calibrated model are not the model's, and what that does to kinematics.
std::string calibration_sentence(const std::vector<Experiment>& experiments) {
  ArmParameters<double> given = experiments.front().model.nominal, calibrated = experiments.front().calibrated.nominal;
  const std::vector<ParameterInfo> before = named_parameters(given), after = named_parameters(calibrated);
  std::string changes;
  for (const ParameterInfo& number : before) {
    const auto now = std::ranges::find(after, number.key, &ParameterInfo::key);  // not there if driven otherwise
    if (now == after.end() || now->number.get() == number.number.get()) continue;
    changes += fmt::format("{}{} {:.4g} to {:.4g}{}", changes.empty() ? "" : ", ", number.name, number.number.get(),
                           now->number.get(), unit_suffix(number.unit));
  }
  const auto gains = [&](const char* name) {
    const std::size_t run = run_named(experiments, name);
    return fmt::format("{}, {} and {}", shown_percent(mean_gain(experiments, run, 0)),
                       shown_percent(mean_gain(experiments, run, 1)), shown_percent(mean_gain(experiments, run, 2)));
  };
  return fmt::format(
      "Calibrated is a model whose numbers were identified with joint sensors on the same robot, as the paper "
      "identified its couplings: {}. Compared with kinematics on the given model, the errors fall by {} "
      "with calibrated kinematics (joints 1, 2, 3), and by {} with the calibrated filter.",
      changes.empty() ? "the given model itself" : changes, gains("kinematics, calibrated"),
      gains("sr_ukf, calibrated"));
}

void add_meaning(report::Page& page, const std::vector<Experiment>& experiments) {
  page.heading("What the numbers mean");
  page.paragraph(
      "These are simulations. The robot has the effects of the table below, which the paper's robot is likely to have "
      "had; their sizes come from the robot's dimensions or are assumed, and none was fitted to the paper's errors. "
      "The estimators believe the paper's Table I and are told of none.");
  page.table(robot_table(experiments));
  page.paragraph(
      fmt::format("Kinematics takes the cables as rigid. Its error here is {} that on the robot (joints 1, 2, 3). {} "
                  "{}",
                  share_of_published(experiments), order_of_gains(experiments), peaks_of_joint_one(experiments)));
  page.paragraph(calibration_sentence(experiments));
  page.paragraph(
      "An estimator that gets motor signals alone infers the stretch of its cables from forces. It cannot see a wrong "
      "ratio between motor and joint, nor a zero that homing left off: the motors read the same. To see which effects "
      "a robot has takes joint sensors for once, and halyard diagnose.");
}

/// Errors of each robot of the study, [estimator] and joint side by side.
report::Table study_table(const EffectStudy& study, const std::vector<JointUnit>& units) {
  report::Table table;
  table.caption =
      "Mean absolute error with the robot's effects switched on one by one and off one by one, mean of experiments A, "
      "B and C";
  table.header = {"effects"};
  for (const std::string& name : study.estimators)
    for (std::size_t k = 0; k < units.size(); ++k)
      table.header.push_back(fmt::format("{}, joint {} [{}]", name, k + 1, units[k].shown));
  for (const StudiedRobot& robot : study.robots) {
    std::vector<Cell> row = {robot.name()};
    for (const auto& errors : robot.error)
      for (std::size_t k = 0; k < units.size(); ++k) row.emplace_back(shown_number(errors[k], units[k]));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// The effect that alone makes most of the first estimator's error of joint k.
std::string study_sentence(const EffectStudy& study, int k, const JointUnit& unit) {
  using Has = StudiedRobot::Has;
  const auto error = [&](std::size_t estimator, Has has, const std::string& effect = "") {
    return study.robot(has, effect).error[estimator][k];
  };
  const auto most = std::ranges::max_element(study.effects, {}, [&](const auto& e) { return error(0, Has::one, e); });
  if (most == study.effects.end()) return "";
  const auto shown = [&](double value) { return shown_number(value, unit) + " " + unit.shown; };
  const auto gain = [&](Has has, const std::string& effect) {
    const double less = 1 - error(1, has, effect) / error(0, has, effect);
    return shown_percent(std::abs(less)) + (less < 0 ? " more" : " less");
  };
  return fmt::format(
      "Joint {}: kinematics errs {} with none of the effects and {} with all of them; {} makes the most, {} alone, and "
      "without it {} are left. {} errs {} than kinematics where the robot has none of the effects, {} where it has "
      "all, and {} where it has all but {}.",
      k + 1, shown(error(0, Has::none)), shown(error(0, Has::all)), *most, shown(error(0, Has::one, *most)),
      shown(error(0, Has::all_but_one, *most)), study.estimators[1], gain(Has::none, ""), gain(Has::all, ""),
      gain(Has::all_but_one, *most), *most);
}

void add_study(report::Page& page, const EffectStudy& study, const std::vector<JointUnit>& units) {
  page.heading("Which effect makes how much of the error");
  page.table(study_table(study, units));
  for (std::size_t k = 0; k < units.size(); ++k) page.paragraph(study_sentence(study, int(k), units[k]));
  page.paragraph(
      "Errors do not add up: two effects may cancel where they differ in sign, and one may act through another, as "
      "friction on the pulleys does through the cable's stretch. An effect counts for all joints together.");
}

void add_figures(report::Page& page, const Experiment& experiment) {
  const Comparison& comparison = experiment.comparison;
  for (int k = 0; k < comparison.n_joints(); ++k) {
    page.heading(fmt::format("{}. Joint {}", experiment.name, k + 1));
    report::Chart positions = trajectory_chart(comparison, k);
    report::Series desired{.name = "desired", .x = comparison.truth.time, .dashed = true, .colour = kDesiredColour};
    for (const double q : experiment.desired[k]) desired.y.push_back(comparison.units[k].shown_per_si * q);
    positions.series.insert(positions.series.begin(), std::move(desired));
    page.chart(positions);
    page.figure_row({error_chart(comparison, k), error_histogram(comparison, k)});
  }
}

}  // namespace

report::Table mean_error_table(const std::vector<Experiment>& experiments) {
  const Comparison& comparison = first(experiments);
  report::Table table;
  table.caption =
      "Mean absolute error (the paper's Eq. 18) and improvement over kinematics, mean of experiments A, B and C; "
      "robot: measured";
  table.header = {"where", "estimator"};
  table.align = {Align::left, Align::left};
  for (int k = 0; k < comparison.n_joints(); ++k) {
    table.header.insert(table.header.end(),
                        {fmt::format("joint {} [{}]", k + 1, comparison.units[k].shown), "improvement"});
    table.align.insert(table.align.end(), {Align::right, Align::right});
  }
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    std::vector<Cell> row = {"simulated", comparison.runs[i].name};
    const bool is_baseline = i == comparison.baseline();
    for (int k = 0; k < comparison.n_joints(); ++k) {
      row.emplace_back(shown_number(mean_error(experiments, i, k), comparison.units[k]));
      row.emplace_back(is_baseline ? "-" : shown_percent(mean_gain(experiments, i, k)));
    }
    table.rows.push_back(std::move(row));
  }
  for (std::size_t i = 0; i < published_errors().size(); ++i) {
    const PublishedErrors& published = published_errors()[i];
    std::vector<Cell> row = {"robot", published.source};
    for (int k = 0; k < comparison.n_joints(); ++k) {
      row.emplace_back(fmt::format("{:.4g}", published.error[k]));
      row.emplace_back(i == 1 ? shown_percent(published_gain(k)) : std::string("-"));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

report::Table experiment_table(const std::vector<Experiment>& experiments) {
  const Comparison& all = first(experiments);
  const std::size_t filter = run_named(experiments, "sr_ukf");
  report::Table table;
  table.caption =
      "Mean absolute error by joint and experiment, and the filter's improvement over kinematics, here and on the "
      "robot";
  table.header = {"joint", "experiment", "unit"};
  for (const EstimatorRun& run : all.runs) table.header.push_back(run.name);
  table.header.insert(table.header.end(), {"improvement by sr_ukf", "by the paper's UKF, robot"});
  table.align.assign(table.header.size(), Align::right);
  std::fill_n(table.align.begin(), 3, Align::left);
  for (int k = 0; k < all.n_joints(); ++k) {
    for (std::size_t e = 0; e < experiments.size(); ++e) {
      const Comparison& comparison = experiments[e].comparison;
      std::vector<Cell> row = {std::to_string(k + 1), experiments[e].name, all.units[k].shown};
      for (const auto& errors : comparison.errors)
        row.emplace_back(shown_number(errors[k].mean_absolute, all.units[k]));
      row.emplace_back(shown_percent(comparison.improvement_of(filter, k)));
      row.emplace_back(shown_percent(k == 1 ? kTableThreeJointTwoGain[e] : kNan));
      table.rows.push_back(std::move(row));
    }
    std::vector<Cell> mean = {std::to_string(k + 1), "mean", all.units[k].shown};
    for (std::size_t i = 0; i < all.runs.size(); ++i)
      mean.emplace_back(shown_number(mean_error(experiments, i, k), all.units[k]));
    mean.emplace_back(shown_percent(mean_gain(experiments, filter, k)));
    mean.emplace_back(shown_percent(published_gain(k)));
    table.rows.push_back(std::move(mean));
  }
  return table;
}

std::string order_of_gains(const std::vector<Experiment>& experiments) {
  const std::size_t filter = run_named(experiments, "sr_ukf");
  const auto ordered = [](double a, double b, double c) { return a < b && b < c; };
  std::string where;
  for (const Experiment& e : experiments) {
    const auto gain = [&](int k) { return e.comparison.improvement_of(filter, k); };
    where += fmt::format("{}{} in {}", where.empty() ? "" : ", ",
                         ordered(gain(0), gain(1), gain(2)) ? "holds" : "does not hold", letter(e));
  }
  const auto gain = [&](int k) { return mean_gain(experiments, filter, k); };
  return fmt::format(
      "The filter improves joints 1, 2 and 3 by {}, {} and {} here, and by {}, {} and {} on the robot. The robot's "
      "order, joint 1 < joint 2 < joint 3, {} in the mean ({}).",
      shown_percent(gain(0)), shown_percent(gain(1)), shown_percent(gain(2)), shown_percent(published_gain(0)),
      shown_percent(published_gain(1)), shown_percent(published_gain(2)),
      ordered(gain(0), gain(1), gain(2)) ? "holds" : "does not hold", where);
}

std::string peaks_of_joint_one(const std::vector<Experiment>& experiments) {
  const std::size_t filter = run_named(experiments, "sr_ukf"), baseline = run_named(experiments, "kinematics");
  std::string text;
  for (const Experiment& e : experiments) {
    const JointUnit& unit = e.comparison.units[0];
    text += fmt::format("{}{} to {} {} in {}", text.empty() ? "" : ", ",
                        shown_number(e.comparison.errors[baseline][0].peak, unit),
                        shown_number(e.comparison.errors[filter][0].peak, unit), unit.shown, letter(e));
  }
  return "The filter made joint 1's peak error worse on the robot; here it goes from " + text + ".";
}

std::string share_of_published(const std::vector<Experiment>& experiments) {
  const Comparison& comparison = first(experiments);
  std::string text;
  for (int k = 0; k < comparison.n_joints(); ++k) {
    const double here = comparison.units[k].shown_per_si * mean_error(experiments, comparison.baseline().value(), k);
    text += fmt::format("{}{:.2g}", text.empty() ? "" : ", ", here / published_errors()[0].error[k]);
  }
  return text + " times";
}

report::Page experiments_page(const std::vector<Experiment>& experiments, const std::optional<EffectStudy>& study) {
  report::Page page("The paper's experiments, simulated",
                    "RAVEN-II, joints 1 to 3: Haghighipanah, Li, Miyasaka, Hannaford, IROS 2015");
  page.paragraph(
      fmt::format("Sines on all joints, {:g} s each. Every estimator gets motor torques and quantised motor positions "
                  "and nothing of the joints. Errors are estimate minus the truth of the simulation, from {:g} s on.",
                  first(experiments).truth.duration(), first(experiments).skip_s));
  page.table(mean_error_table(experiments));
  page.table(experiment_table(experiments));
  page.paragraph(
      "Only a part of the paper's Table III is known here: the improvements of joint 2; that the filter made the peak "
      "error of joint 1 worse in all three experiments; and that the rows of B and C for joint 3 are equal, which is "
      "probably an error of the table.");
  add_meaning(page, experiments);
  if (study) add_study(page, *study, first(experiments).units);
  for (const Experiment& experiment : experiments) {
    page.heading("Experiment " + experiment.name);
    page.table(error_table(experiment.comparison));
    add_figures(page, experiment);
  }
  return page;
}

}  // namespace halyard
