#pragma once
/// One round of the search: a quick look at every candidate, then a full fit of the best.

#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "diagnosis/judgement/judge.h"
#include "diagnosis/round/joint_proposal.h"
#include "diagnosis/starts/screen.h"

namespace halyard {

/// Name of the current stage and its completed fraction; called by several threads.
using SearchProgress = std::function<void(const std::string&, double)>;

/// What is known of one candidate before its fit has converged.
struct Prospect {
  bool is_judged = false;  ///< see Trial
  double gain = 0;
  double left = std::numeric_limits<double>::infinity();  ///< see Screen::left()
};
/// Indices of those whose fit is worth to be continued: some that are judged and gain most, more than `share` of the
/// largest gain, and some that leave least, judged or not. A fit overshoots where the model's numbers are not linear:
/// the right candidate may gain nothing yet.
std::vector<std::size_t> leaders_of(const std::vector<Prospect>& prospects, double share);

/// True if a candidate may be right in place of a name. It gains at least the share `rivals` of decision_rule.h of what
/// the name gains, or takes at least half as much of the residual away. What it gains has to be a part of what the name
/// gains. shared: shared_gain() of both; left_without: what is left without either.
bool is_rival(const Prospect& candidate, double shared, const Prospect& standing, double left_without);

class CandidateRound {
 public:
  /// without: the hypothesis against which candidates are judged; from: where their fits start.
  CandidateRound(const Evidence& evidence, const ArmModel& model, const Refitter& refitter, const Judge& judge,
                 Scored without, Hypothesis from, const std::string& name, const SearchProgress& progress);

  /// A trial of each candidate, the largest gain first. Empty if the sensitivities cannot be computed.
  std::vector<Trial> look(const std::vector<PlacedEffect>& candidates);
  /// Fits the leaders fully and judges them anew: the trials that gain most, and those that would leave least once the
  /// model's parameters have followed. The quick look computes the sensitivities of these parameters once; here they
  /// are renewed until nothing changes. Which end of its quick fits a candidate goes on from is decided after one such
  /// pass from each. After a few passes, those that are judged and still lead go on; a candidate whose gain is not
  /// significant by then does not. Returns a fit for each trial of the last look(), unusable where there was none.
  std::vector<Fit> fit_leaders(std::vector<Trial>& trials) const;
  /// Between look() and fit_leaders(), if the candidates compete for the place of a name: the leaders are then chosen
  /// among its rivals, and the name itself is one only if its quick fit gains more than its present fit `with`.
  void keep_rivals_of(const Trial& standing, const Hypothesis& with, const std::vector<Trial>& trials);
  /// What the look has found to first order.
  const LinearRound& linear() const { return linear_; }

 private:
  /// For the quick look.
  const Evidence& quick() const { return coarse_ ? *coarse_ : evidence_; }
  /// Calls one(i) for all i < n, side by side.
  void each(const std::string& what, std::size_t n, const std::function<void(std::size_t)>& one) const;
  /// A candidate after its quick fits, one from each start.
  struct Look {
    Trial trial;                                            ///< of the best
    std::vector<Hypothesis> ends;                           ///< different ones, the best first; empty if none is usable
    double left = std::numeric_limits<double>::infinity();  ///< the least of all ends, see Screen::left()
  };
  void quick_fits(const std::vector<std::size_t>& candidates, std::vector<Look>& looks) const;
  /// See Screen::left().
  double left_at(const Hypothesis& h) const { return screen_->left(quick().fit_rows({h})[0]); }
  bool is_same_end(const Hypothesis& a, const Hypothesis& b) const;
  /// The effects so far and the model's numbers stay linear.
  Fit quick_fit(const Hypothesis& start) const;
  /// A full fit of the same candidate.
  Refit refit_from(const Hypothesis& end) const;
  void give_up_bounds(Refit& refit, Trial& trial) const;
  double least_promise() const;

  const Evidence& evidence_;
  const ArmModel& model_;
  const Refitter& refitter_;
  const Judge& judge_;
  Scored without_;
  LinearRound linear_;
  std::unique_ptr<Evidence> coarse_;                ///< around linear_.from; null: there is none
  std::optional<Screen> screen_;                    ///< of the last look
  std::vector<std::vector<Hypothesis>> ends_;       ///< of the quick fits of each trial
  std::vector<Prospect> prospects_;                 ///< of the trials of the last look
  std::vector<std::size_t> leaders_;                ///< trials that are fitted fully
  std::vector<FitParameter> found_;                 ///< of the effects so far
  std::vector<std::vector<double>> found_columns_;  ///< sensitivities to them
  std::vector<double> scale_;                       ///< [2n] of the residual
  std::string name_;
  const SearchProgress& progress_;
};

}  // namespace halyard
