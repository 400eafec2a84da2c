#pragma once
/// The thresholds that decide what a diagnosis names: what each means, its value, and why. Those without a reason were
/// chosen by hand; only the blind trials test them, all together or one by one (`halyard_blind_trials --rule`).
/// Thresholds that only one step uses stand beside it.

#include <cstddef>
#include <string>

namespace halyard {

struct DecisionRule {
  // A candidate is named.

  /// A candidate has to explain this share of the mean square that is left in a channel. A smaller share cannot be told
  /// from an error of a parameter of the model. Reason: 5 % of the mean square is 2.5 % of the root mean square.
  double share = 0.05;
  /// Even the right effect may miss the truth, because the form of its equation differs. This is the root mean square
  /// of what it may miss, relative to what it does in the same block of time. An effect that explains less than
  /// this beside a larger effect may be the larger effect's error of form. A residual that is smaller than this is
  /// not told. Reason: in the logs with other equations (rounded backlash, Bouc-Wen, LuGre) the right effect leaves 2
  /// to 15 %.
  double form_misfit = 0.15;
  /// The same for an effect that only changes a number of the model, as an offset does: its equation has no other form.
  /// Reason: what it misses comes from the model's other numbers, which are some percent off.
  double number_misfit = 0.03;
  /// An effect that explains less still matters if the model's numbers lie so much closer to the model's values with
  /// it: fall of their prior cost ½ Σ u². Reason: a number at the end of its tolerance costs 2, so without the effect
  /// five numbers would have to be there. A residual that numbers hide is no error of form of an effect found before.
  double relief = 10;
  /// The change by an effect has to be this many times the floor of its channel, in at least one signal. Reason: a
  /// change as large as the floor is as large as the noise.
  double above_floor = 1.5;
  /// Gain in log-likelihood that one more parameter gives by chance. Reason: two standard deviations of χ²(1) / 2.
  double by_chance = 2;
  /// Prior cost of a candidate with a parameter at its bound, nats. Reason: a number at the end of its tolerance costs
  /// 2.
  double at_bound = 2;
  /// A candidate whose quick fit has a larger p value than this is neither fitted fully nor judged further, except the
  /// `leaders_by_rest`.
  double worth_a_fit = 0.05;
  /// A parameter that makes the effect what its name says, as the rate makes a drift, has to gain with a smaller p
  /// value. Reason: the effect has already convinced; this only decides between two names.
  double essential_level = 0.05;
  /// In a revision, a name competes with its fit in this round if that costs less than the earlier one by this.
  /// Reason: a quarter of what one more parameter gains by chance decides nothing.
  double worth_a_change = 0.5;

  // Several effects are proposed together.

  /// So many sets of each size are grown further in the selection. Reason: of two effects that hide each other, one is
  /// rarely the best alone, but among the best few.
  std::size_t sets_kept = 4;

  // A remaining residual is reported.

  /// A residual matters above this many times the floor of its channel: about one resolution of a joint's encoder.
  double rest_ratio = 3;
  /// A residual whose root mean square falls to this share is next to nothing: it has a hundredth of its mean square.
  double next_to_none = 0.1;

  /// The search ends if no channel has a residual above this many times its floor. Reason: the noise, and with it the
  /// floor, is estimated to some percent.
  double explained_ratio = 1.1;

  // Alternatives and probabilities.

  /// Two candidates whose gains differ by less than this many standard errors cannot be told apart. Reason: by chance
  /// they differ by more in one case of twenty.
  double tell_apart = 2;
  /// Two candidates are alternatives if they share at least this fraction of the smaller gain (shared_gain()).
  double shared_gain = 0.5;
  /// Prior cost of an effect, nats. Reason: an arm has few of those in the library. Two effects that explain as much as
  /// one are less plausible.
  double cost_of_effect = 1.5;
  /// Prior cost of each number of an effect, nats. Reason: numbers that the data do not need are already paid for,
  /// because the likelihood is that of blocks which no fit has used. With one nat for each number, names with a
  /// probability of 0.5 to 0.9 came true in 55 % of 88 cases of blind trials before those in
  /// docs/blind_trials_before.md.
  double cost_of_number = 0.5;
  /// Prior cost of an effect whose shape lies where it is another effect, which is named, nats. Reason: a loop that
  /// yields at once is a softer cable, and about a third of the loops do so in a log. With the numbers that the two
  /// have, a softer cable has 62 % of the weight where both explain the same, so that beside other names it is a guess
  /// (sure_name).
  double cost_of_a_limit = 1;
  /// s of P(none), see name_probability.h.
  double none_sharpness = 1.5;
  /// Where something acts for certain that is not in the library, a name of the same joint is wrong at least with this
  /// probability: it may imitate a part of that. Reason: in blind trials (seed 20271211, docs/blind_trials_before.md),
  /// two of five such names came true. With 0.6 none would keep its name, for which five are too few; with 0.4 those
  /// keep it that have hardly any alternative.
  double wrong_beside_a_rest = 0.4;
  /// Of what the evidence makes certain, this share is told as the probability: of a name, and of a cause outside the
  /// library. The evidence does not know that the search may have missed the right candidate. Reason: in blind trials
  /// (docs/blind_trials_before.md), names for which the evidence had more than 0.9 came true in 224 of 236 cases (seed
  /// 20271211) and in 388 of 398 (20271208, 20271209); such causes in 29 of 33 (20271211).
  double right_if_certain = 0.97, outside_if_certain = 0.9;
  /// An effect is told if this is the least probability that its name or one of its alternatives is right, and that the
  /// name is, if it is the only effect with more than one alternative. Reason: below one half it is more probable that
  /// they are wrong.
  double worth_a_name = 0.5;
  /// If several effects were found, one gets a name if its name has at least this weight among its alternatives
  /// (Naming::weight). Reason: three to one. In blind trials (seeds 20271202 and 20271204,
  /// docs/blind_trials_before.md), names of less weight came true in 10 of 18 cases beside other names. Of two or three
  /// hidden effects, names of more weight came true in 245 of 250.
  double sure_name = 0.75;
  /// The set of names that is reported holds the truth with this probability, if one of the names is right.
  double set_share = 0.9;

  // Numbers of the model.

  /// A refitted number is reported if it lies so many standard deviations off the model's number. Reason: a model has
  /// some thirty numbers. Then two in a thousand diagnoses of clean arms report a number by chance. The same for a
  /// shape of an effect that has a usual value, as sharp edges of a gap.
  double unusual_deviations = 4;

  /// Prior cost of a model that is off by up to twice what its tolerances say, nats; as much again for each doubling.
  /// Reason: one model in ten.
  double cost_of_wider_tolerances = 2.3;
  /// With other tolerances, a name whose removal costs so many nats after the first pass of the fit is needed. Reason:
  /// further passes win back up to 70 % (39 fits of two logs with three effects), and the prior gains less than ten by
  /// a name fewer.
  double certainly_needed = 100;
  /// The tolerances of a model count up to this many times. Reason: a model that is off by more is to be corrected by
  /// its user; the trials go up to two.
  double widest_tolerances = 4;

  // The effort of the search.

  /// A candidate that promises less than this share of the residual, to first order, is not fitted.
  double promise = 0.02;
  /// Nor is one that promises less than this share of a single channel. Reason: that of six channels which is 0.02 of
  /// all.
  double promise_of_channel = 0.12;
  /// Number of candidates that are fitted in a round: those with the smallest residual at the start of their search.
  std::size_t most_fitted = 16;
  /// Number of starts of a candidate with shapes from which its quick fit begins, each at other shapes. Reason: the
  /// start that leaves least is often not in the lowest minimum.
  std::size_t starts_fitted = 3;
  /// The same of a candidate with a shape at one end of which it is another effect (another_at). Reason: a fit that
  /// runs there is lost. In a log with three effects, three of the five yield stretches of a hysteresis ran there.
  std::size_t starts_fitted_beside_another = 5;
  /// Of the candidates that were fitted, the `leaders` that gain most are fitted fully, if their gain is more than the
  /// share `leads` of the largest gain. So are the `leaders_by_rest` whose fits leave least. Reason: a quick fit keeps
  /// the model's numbers linear, and its gain can be negative, or not significant, although the effect is the right
  /// one.
  std::size_t leaders = 4, leaders_by_rest = 2;
  double leads = 0.25;
  /// In a revision, a candidate is fitted fully if its quick fit gains this share of what the name gains, or takes at
  /// least half as much of the residual away. Reason: in two logs with three effects each, the full fits of those that
  /// did neither ended at most with three quarters of the name's gain.
  double rivals = 1.0 / 3;
  /// A fit is nudged again if the last nudges gained more than this in log-likelihood. Reason: a quarter of what one
  /// more parameter gains by chance decides nothing.
  double worth_a_nudge = 0.5;
  /// After `first_passes` passes, the same rule with the share `still_leads` decides which of the full fits go on, up
  /// to `most_passes` in all; but only those with a significant gain.
  int first_passes = 3, most_passes = 12;
  double still_leads = 0.5;
};

/// The rule of every diagnosis. Only vary_rule() changes it.
extern const DecisionRule& kRule;

/// Gives a threshold another value, to measure what it does: `halyard_blind_trials --rule`. Not while a diagnosis runs.
/// Throws std::invalid_argument for a name that is none, and for a value that no threshold can have.
void vary_rule(const std::string& name, double value);

}  // namespace halyard
