#include "diagnosis/fit/bounded_least_squares.h"

#include <ceres/ceres.h>

#include <algorithm>

namespace halyard {
namespace {

/// Parameters at a bound.
std::vector<int> at_bounds(const ceres::Problem& problem, const std::vector<double>& u) {
  std::vector<int> all;
  for (int i = 0; i < static_cast<int>(u.size()); ++i)
    if (u[i] <= problem.GetParameterLowerBound(u.data(), i) || u[i] >= problem.GetParameterUpperBound(u.data(), i))
      all.push_back(i);
  return all;
}

/// Parameters at a bound beyond which the cost would fall. Ceres clips a step at the bounds, and the step of the others
/// is then the wrong one: it is rejected again and again, and the fit ends far from its minimum.
std::vector<int> pressed(const ceres::Problem& problem, const LinearisedResidual& at, const std::vector<double>& u) {
  const Eigen::VectorXd gradient =
      at.J.transpose() * Eigen::Map<const Eigen::VectorXd>(at.r.data(), static_cast<Eigen::Index>(at.r.size()));
  std::vector<int> all = at_bounds(problem, u);
  std::erase_if(all, [&](int i) {
    return u[i] <= problem.GetParameterLowerBound(u.data(), i) ? gradient(i) <= 0 : gradient(i) >= 0;
  });
  return all;
}

/// Stops the solver when a step has led to a bound at which nothing was when it started.
class StopAtBound : public ceres::IterationCallback {
 public:
  StopAtBound(const ceres::Problem& problem, const std::vector<double>& u) : problem_(problem), u_(u) {}
  void start() { known_ = at_bounds(problem_, u_); }
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    if (!step.step_is_successful) return ceres::SOLVER_CONTINUE;
    return std::ranges::includes(known_, at_bounds(problem_, u_)) ? ceres::SOLVER_CONTINUE
                                                                  : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

 private:
  const ceres::Problem& problem_;
  const std::vector<double>& u_;
  std::vector<int> known_;
};

ceres::Solver::Options solver_options(const LeastSquaresOptions& options) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = options.iterations;
  solver.function_tolerance = options.cost_tolerance;
  solver.parameter_tolerance = options.parameter_tolerance;
  solver.gradient_tolerance = options.gradient_tolerance;
  solver.logging_type = ceres::SILENT;  // a trial step that cannot be evaluated is foreseen
  solver.num_threads = 1;
  // With bounds Ceres would add a line search to each step: two of three evaluations, and no better minimum.
  solver.max_num_line_search_step_size_iterations = 0;
  solver.update_state_every_iteration = true;
  return solver;
}

}  // namespace

LinearisedResidual::LinearisedResidual(const ceres::CostFunction& residual, const std::vector<double>& u)
    : r(residual.num_residuals()), J(residual.num_residuals(), u.size()) {
  const double* at = u.data();
  double* jacobian = J.data();
  finite = residual.Evaluate(&at, r.data(), &jacobian);
}

bool minimise(const ceres::CostFunction& residual, const std::vector<double>& lower, const std::vector<double>& upper,
              const LeastSquaresOptions& options, std::vector<double>& u) {
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(const_cast<ceres::CostFunction*>(&residual), nullptr, u.data());
  for (std::size_t i = 0; i < u.size(); ++i) {
    problem.SetParameterLowerBound(u.data(), static_cast<int>(i), lower[i]);
    problem.SetParameterUpperBound(u.data(), static_cast<int>(i), upper[i]);
    u[i] = std::clamp(u[i], lower[i], upper[i]);
  }
  ceres::Solver::Options solver = solver_options(options);
  std::vector<int> held;
  StopAtBound stop(problem, u);
  solver.callbacks.push_back(&stop);
  for (bool has_settled = false; solver.max_num_iterations > 0;) {
    // Ceres would write to the log of the host program if the start cannot be evaluated. A residual that keeps its last
    // result, as that of fit.cpp, does not compute it again for Ceres' first step.
    const LinearisedResidual at(residual, u);
    if (!at.finite) return false;
    std::vector<int> now = pressed(problem, at, u);
    if (now.size() == u.size() || (has_settled && now == held)) break;
    held = std::move(now);
    problem.SetManifold(u.data(), held.empty() ? nullptr : new ceres::SubsetManifold(static_cast<int>(u.size()), held));
    stop.start();
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    if (summary.termination_type == ceres::FAILURE) return false;
    has_settled = summary.termination_type == ceres::CONVERGENCE;
    solver.max_num_iterations -= static_cast<int>(summary.iterations.size()) - 1;
  }
  return true;
}

}  // namespace halyard
