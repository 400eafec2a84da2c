#include "diagnosis/round/joint_proposal.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/prediction/side_by_side.h"
#include "diagnosis/round/essence.h"
#include "diagnosis/round/sparse_selection.h"

namespace halyard {
namespace {

/// What the candidates of a round do to first order, beside the model's numbers u and the effects so far:
/// residual + J (u - u0) + E a is to be made small.
class LinearProblem {
 public:
  LinearProblem(const Evidence& evidence, const Refitter& refitter, const LinearRound& round, std::size_t given)
      : refitter_(refitter), round_(round) {
    const std::vector<double> residual = evidence.fit_rows({round.from})[0];
    sizes_so_far_ = refitter.parameters(round.from);
    std::erase_if(sizes_so_far_, [&](const FitParameter& p) { return p.effect < given || p.shape || p.is_whole; });
    const auto columns_so_far = sensitivities(evidence, round.from, sizes_so_far_);
    usable_ = !residual.empty() && columns_so_far.size() == sizes_so_far_.size() &&
              round.columns.size() == round.numbers.size();
    if (!usable_) return;

    problem_.x = -Eigen::Map<const Eigen::VectorXd>(residual.data(), std::ssize(residual));
    for (std::size_t i = 0; i < round.numbers.size(); ++i) {
      const FitParameter& p = round.numbers[i];
      add(p, round.columns[i], p.nominal, 1);
      problem_.x += (parameter_value(round.from, p) - p.nominal) / p.scale * column(round.columns[i]);
    }
    for (std::size_t i = 0; i < sizes_so_far_.size(); ++i)
      add(sizes_so_far_[i], columns_so_far[i], parameter_value(round.from, sizes_so_far_[i]), 0);
    problem_.free = std::ssize(columns_);
    for (std::size_t s = 0; s < round.starts.size(); ++s)
      for (const Directions& d : round.starts[s].directions) {
        const Eigen::Index first = std::ssize(columns_), n = std::ssize(d.sizes);
        for (const FitParameter& p : d.sizes)
          add(p, d.columns[columns_.size() - static_cast<std::size_t>(first)], p.nominal, 0);
        // All sizes, or one of them.
        if (n > 1) add_group(d, first, {first, n, static_cast<int>(d.numbers), static_cast<int>(s)});
        for (Eigen::Index i = 0; i < n; ++i)
          add_group(d, first, {first + i, 1, static_cast<int>(d.numbers - n + 1), static_cast<int>(s)});
      }
    finish(evidence);
  }

  bool usable() const { return usable_; }
  const SparseProblem& problem() const { return problem_; }
  /// The hypothesis of the round with the selected effects.
  Hypothesis hypothesis(const SelectedGroups& selected) const {
    Hypothesis h = round_.from;
    Eigen::Index next = 0;
    const auto move = [&](Hypothesis& moved, const FitParameter& p, double from) {
      set_parameter(moved, p, std::clamp(from + selected.amount(next++) * p.scale, p.lower, p.upper));
    };
    for (const FitParameter& p : round_.numbers) move(h, p, p.nominal);
    for (const FitParameter& p : sizes_so_far_) move(h, p, parameter_value(round_.from, p));
    for (const std::size_t g : selected.groups) {
      Hypothesis one = choices_[g].first->neutral;
      const auto& [directions, first] = choices_[g];
      next = first;
      for (const FitParameter& p : directions->sizes) move(one, p, p.nominal);
      one.past.resize(one.effects.size());
      h = refitter_.with_effect(h, one.effects.back(), one.past.back());
    }
    return h;
  }

 private:
  static Eigen::Map<const Eigen::VectorXd> column(const std::vector<double>& rows) {
    return {rows.data(), std::ssize(rows)};
  }
  /// A column whose amount counts from that value of its parameter.
  void add(const FitParameter& p, const std::vector<double>& rows, double from, double prior) {
    columns_.push_back(column(rows));
    lower_.push_back((p.lower - from) / p.scale);
    upper_.push_back((p.upper - from) / p.scale);
    prior_.push_back(prior);
  }
  void add_group(const Directions& d, Eigen::Index first, const ColumnGroup& group) {
    choices_.emplace_back(&d, first);
    problem_.groups.push_back(group);
  }
  void finish(const Evidence& evidence) {
    problem_.columns.resize(problem_.x.size(), std::ssize(columns_));
    for (std::size_t i = 0; i < columns_.size(); ++i) problem_.columns.col(static_cast<Eigen::Index>(i)) = columns_[i];
    columns_.clear();
    problem_.lower = column(lower_);
    problem_.upper = column(upper_);
    problem_.prior = column(prior_);
    problem_.channel = evidence.row_channel();
    problem_.least_square = squared_floors(evidence);
    for (int c = 0; c < evidence.channels(); ++c) problem_.correlated_rows.push_back(evidence.correlated_rows(c));
  }

  const Refitter& refitter_;
  const LinearRound& round_;
  std::vector<FitParameter> sizes_so_far_;  ///< of the effects that were added before
  bool usable_ = false;
  SparseProblem problem_;
  std::vector<std::pair<const Directions*, Eigen::Index>> choices_;  ///< of each group, and their first column
  std::vector<Eigen::Map<const Eigen::VectorXd>> columns_;
  std::vector<double> lower_, upper_, prior_;
};

}  // namespace

Hypothesis JointSearch::select(const LinearRound& round, int most) const {
  const LinearProblem linear(evidence_, refitter_, round, given_);
  if (!linear.usable()) return round.from;
  return linear.hypothesis(select_groups(linear.problem(), static_cast<std::size_t>(most), kRule.sets_kept));
}

std::vector<Trial> JointSearch::trials(const JointProposal& p, std::size_t first, std::vector<Fit>& without) const {
  const std::size_t n = p.fit.hypothesis.effects.size() - first;
  std::vector<Trial> all(n);
  without.assign(n, {});
  run_side_by_side(n, [&](std::size_t i) {
    const std::size_t place = first + i;
    Refit refit{without_effect(p.fit.hypothesis, place), p.score};
    refitter_.go_on(refit, kRule.first_passes);
    without[i] = refit.best;
    const Hypothesis left = refit.best.usable ? refit.best.hypothesis : refit.at;
    all[i] = judge_.trial(p.fit.hypothesis, {left, evidence_.score(left)}, place);
    if (all[i].can_be_named())
      all[i].is_another = is_another_effect(evidence_, refitter_, judge_, {p.fit.hypothesis, p.score}, place);
  });
  return all;
}

JointProposal JointSearch::propose(const LinearRound& round, const Scored& without, double significance,
                                   int most) const {
  JointProposal p;
  const std::size_t first = round.from.effects.size();
  const Hypothesis start = select(round, most);
  if (start.effects.size() == first) return p;
  const Score at_start = evidence_.score(start);
  p.fit = refitter_.refit(start, at_start.finite ? at_start : without.score);
  while (p.fit.usable && p.fit.hypothesis.effects.size() > first) {
    p.score = evidence_.score(p.fit.hypothesis);
    if (!p.score.finite) return p;
    std::vector<Fit> fits;
    p.trials = trials(p, first, fits);
    // A single effect has failed in the round: it is one of all its candidates that were tried twice.
    const std::size_t tried = p.trials.size() > 1 ? p.trials.size() : round.starts.size();
    const double each = significance / static_cast<double>(tried);
    std::size_t worst = p.trials.size();
    for (std::size_t i = 0; i < p.trials.size(); ++i)
      if (!p.trials[i].passes(each) && (worst == p.trials.size() || p.trials[i].gain < p.trials[worst].gain)) worst = i;
    if (worst == p.trials.size()) {
      p.is_convincing = judge_.p_of_gain(p.score, without.score) <= significance;
      return p;
    }
    p.fit = fits[worst];
  }
  return p;
}

}  // namespace halyard
