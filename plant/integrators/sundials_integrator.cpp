#include "plant/integrators/integrator.h"

#include <arkode/arkode_arkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <stdexcept>
#include <string>

namespace halyard {
namespace {

/// Of CVODE as the reference against the tolerances asked for.
constexpr double kReferenceTightening = 1e-5;
/// Steps between two ticks before the motion counts as not integrable.
constexpr long kMaxSteps = 100000;
/// ARKODE's name for the predictor that extrapolates the last step.
constexpr int kMaximumOrder = 1;
/// Newton's error against the step's; ARKODE's own 0.1 leaves Newton's error the larger one (1.7e-8 against 6e-9 rad).
constexpr double kNewtonShare = 0.01;
/// SUNDIALS' objects and the callbacks that its solvers share. One context an integrator, so one a thread.
class Sundials : public Integrator {
 public:
  const Eigen::VectorXd& state() const override { return y_; }

 protected:
  Sundials(ArmPlant& plant, const IntegratorOptions& options, double time_s, const Eigen::VectorXd& y)
      : plant_(plant),
        options_(options),
        time_(time_s),
        y_(y),
        tolerance_(absolute_tolerances(plant.drive(), options.absolute_tolerance)) {
    if (SUNContext_Create(nullptr, &context_)) throw std::runtime_error("SUNDIALS gives no context");
    const sunindextype size = y.size();
    vector_ = N_VMake_Serial(size, y_.data(), context_);
    tolerance_vector_ = N_VMake_Serial(size, tolerance_.data(), context_);
    matrix_ = SUNDenseMatrix(size, size, context_);
    solver_ = SUNLinSol_Dense(vector_, matrix_, context_);
    if (!vector_ || !tolerance_vector_ || !matrix_ || !solver_) {
      release();
      throw std::runtime_error("SUNDIALS gives no vectors");
    }
  }

  ~Sundials() override { release(); }
  Sundials(const Sundials&) = delete;
  Sundials& operator=(const Sundials&) = delete;

  /// SUNDIALS says something went wrong: kept for the exception, not printed.
  static void keep_message(int, const char*, const char*, char* message, void* self) {
    static_cast<Sundials*>(self)->message_ = message;
  }

  static void check(int flag, const char* what) {
    if (flag < 0) throw std::runtime_error(std::string("SUNDIALS refuses ") + what);
  }

  void forget_failures() {
    message_.clear();
    thrown_.clear();
  }
  [[noreturn]] void fail(double until_s) const { fail_between(time_, until_s, thrown_.empty() ? message_ : thrown_); }

  /// Runs a callback; an exception must not cross SUNDIALS' C code, and asks for a smaller step instead.
  template <class Call>
  int guarded(Call call) {
    try {
      call();
      return 0;
    } catch (const std::exception& error) {
      thrown_ = error.what();
    } catch (...) {
      thrown_ = "an exception of unknown type";
    }
    return 1;
  }

  static int derivative(realtype t, N_Vector y, N_Vector y_dot, void* self) {
    auto* s = static_cast<Sundials*>(self);
    return s->guarded([&] { s->plant_.derivative(t, N_VGetArrayPointer(y), N_VGetArrayPointer(y_dot)); });
  }

  static int jacobian(realtype t, N_Vector y, N_Vector, SUNMatrix J, void* self, N_Vector, N_Vector, N_Vector) {
    auto* s = static_cast<Sundials*>(self);
    return s->guarded([&] {
      Eigen::Map<Eigen::MatrixXd> map(SUNDenseMatrix_Data(J), s->y_.size(), s->y_.size());
      s->plant_.jacobian_of_terms(s->implicit_, t, N_VGetArrayPointer(y), map);
    });
  }

  ArmPlant& plant_;
  IntegratorOptions options_;
  DriveTerms implicit_ = DriveTerms::all;  ///< what the Jacobian is of
  double time_;
  Eigen::VectorXd y_, tolerance_;
  SUNContext context_ = nullptr;
  N_Vector vector_ = nullptr, tolerance_vector_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
  std::string message_, thrown_;

 private:
  void release() {
    if (solver_) SUNLinSolFree(solver_);
    if (matrix_) SUNMatDestroy(matrix_);
    if (tolerance_vector_) N_VDestroy(tolerance_vector_);
    if (vector_) N_VDestroy(vector_);
    SUNContext_Free(&context_);
  }
};

/// One-step methods: a tick costs them the saved derivative and no more, so the step size lives on.
class RungeKutta : public Sundials {
 public:
  RungeKutta(ArmPlant& plant, const IntegratorOptions& options, double time_s, const Eigen::VectorXd& y)
      : Sundials(plant, options, time_s, y) {
    int order = 4;
    switch (options.kind) {
      case IntegratorKind::dirk:
        memory_ = ARKStepCreate(nullptr, derivative, time_s, vector_, context_);
        order = 3;
        break;
      case IntegratorKind::explicit_rk: memory_ = ARKStepCreate(derivative, nullptr, time_s, vector_, context_); break;
      default:
        implicit_ =
            options.kind == IntegratorKind::imex_link1 ? DriveTerms::first_cable : DriveTerms::cables_and_friction;
        implicit_rate_.resize(y.size());
        memory_ = ARKStepCreate(explicit_part, implicit_part, time_s, vector_, context_);
    }
    if (!memory_) throw std::runtime_error("SUNDIALS gives no integrator");
    try {
      set_up(order);
    } catch (...) {
      ARKStepFree(&memory_);
      throw;
    }
  }
  ~RungeKutta() override { ARKStepFree(&memory_); }

  void advance(double until_s) override {
    check(ARKStepReset(memory_, time_, vector_), "the state");
    check(ARKStepSetStopTime(memory_, until_s), "the stop time");
    forget_failures();
    if (ARKStepEvolve(memory_, until_s, vector_, &time_, ARK_NORMAL) < 0) fail(until_s);
    time_ = until_s;
  }

 private:
  void set_up(int order) {
    check(ARKStepSetUserData(memory_, static_cast<Sundials*>(this)), "user data");
    check(ARKStepSetErrHandlerFn(memory_, keep_message, static_cast<Sundials*>(this)), "the message handler");
    check(ARKStepSetOrder(memory_, order), "the order");
    check(ARKStepSVtolerances(memory_, options_.relative_tolerance, tolerance_vector_), "the tolerances");
    check(ARKStepSetMaxNumSteps(memory_, kMaxSteps), "the number of steps");
    if (options_.kind == IntegratorKind::explicit_rk) return;
    check(ARKStepSetLinearSolver(memory_, solver_, matrix_), "the linear solver");
    check(ARKStepSetJacFn(memory_, jacobian), "the Jacobian");
    check(ARKStepSetNonlinConvCoef(memory_, kNewtonShare), "the Newton tolerance");
    // A third fewer derivatives: none after a stage is solved, and stages start from the step before.
    check(ARKStepSetDeduceImplicitRhs(memory_, 1), "deduced derivatives");
    check(ARKStepSetPredictorMethod(memory_, kMaximumOrder), "the predictor");
  }

  static int implicit_part(realtype t, N_Vector y, N_Vector y_dot, void* self) {
    auto* s = static_cast<RungeKutta*>(static_cast<Sundials*>(self));
    return s->guarded(
        [&] { s->plant_.derivative_of_terms(s->implicit_, t, N_VGetArrayPointer(y), N_VGetArrayPointer(y_dot)); });
  }

  static int explicit_part(realtype t, N_Vector y, N_Vector y_dot, void* self) {
    auto* s = static_cast<RungeKutta*>(static_cast<Sundials*>(self));
    return s->guarded([&] {
      s->plant_.derivative(t, N_VGetArrayPointer(y), N_VGetArrayPointer(y_dot));
      s->plant_.derivative_of_terms(s->implicit_, t, N_VGetArrayPointer(y), s->implicit_rate_.data());
      Eigen::Map<Eigen::VectorXd>(N_VGetArrayPointer(y_dot), s->y_.size()) -= s->implicit_rate_;
    });
  }

  void* memory_ = nullptr;
  Eigen::VectorXd implicit_rate_;
};

/// Backward differentiation, started anew at each tick.
class Bdf : public Sundials {
 public:
  Bdf(ArmPlant& plant, const IntegratorOptions& options, double time_s, const Eigen::VectorXd& y)
      : Sundials(plant, tightened(options), time_s, y) {
    memory_ = CVodeCreate(CV_BDF, context_);
    if (!memory_) throw std::runtime_error("SUNDIALS gives no integrator");
    try {
      set_up();
    } catch (...) {
      CVodeFree(&memory_);
      throw;
    }
  }
  ~Bdf() override { CVodeFree(&memory_); }

  void advance(double until_s) override {
    check(CVodeReInit(memory_, time_, vector_), "the state");
    check(CVodeSetStopTime(memory_, until_s), "the stop time");
    forget_failures();
    if (CVode(memory_, until_s, vector_, &time_, CV_NORMAL) < 0) fail(until_s);
    time_ = until_s;
  }

 private:
  static IntegratorOptions tightened(IntegratorOptions options) {
    options.relative_tolerance *= kReferenceTightening;
    options.absolute_tolerance *= kReferenceTightening;
    return options;
  }

  void set_up() {
    check(CVodeInit(memory_, derivative, time_, vector_), "the state");
    check(CVodeSetUserData(memory_, static_cast<Sundials*>(this)), "user data");
    check(CVodeSetErrHandlerFn(memory_, keep_message, static_cast<Sundials*>(this)), "the message handler");
    check(CVodeSVtolerances(memory_, options_.relative_tolerance, tolerance_vector_), "the tolerances");
    check(CVodeSetMaxNumSteps(memory_, kMaxSteps), "the number of steps");
    check(CVodeSetLinearSolver(memory_, solver_, matrix_), "the linear solver");
    check(CVodeSetJacFn(memory_, jacobian), "the Jacobian");
  }

  void* memory_ = nullptr;
};

}  // namespace

std::unique_ptr<Integrator> make_sundials_integrator(ArmPlant& plant, const IntegratorOptions& options, double time_s,
                                                     const Eigen::VectorXd& y) {
  if (options.kind == IntegratorKind::bdf) return std::make_unique<Bdf>(plant, options, time_s, y);
  return std::make_unique<RungeKutta>(plant, options, time_s, y);
}

}  // namespace halyard
