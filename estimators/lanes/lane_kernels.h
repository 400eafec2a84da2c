#pragma once
/// The inner loops over the vector types Lanes and Dual. There is one copy per instruction set, chosen at run time.
///
/// Each file lanes_<set>.cpp is compiled with the flags of its set and instantiates lane_kernel_body.h in an
/// anonymous namespace. All functions that the body calls are forced inline. Otherwise the linker could use a function
/// compiled for a wider set in code that must run on every machine. Results of two sets differ by rounding.

#include <vector>

#include "estimators/process/arm_changes.h"

namespace halyard {

struct LaneKernels {
  const char* name;
  /// `substeps` Runge-Kutta steps of dt / substeps from `time` on, in place. x: [layout.size]; command, external: [n].
  void (*advance)(const Transmission<Lanes>& transmission, const StateLayout& layout, double time, double dt,
                  int substeps, const CommandHistory* history, const Lanes* command, const Lanes* external, Lanes* x);
  /// The same with derivatives.
  void (*advance_dual)(const Transmission<Dual>& transmission, const StateLayout& layout, double time, double dt,
                       int substeps, const CommandHistory* history, const Dual* command, const Dual* external, Dual* x);
  /// linearised_derivative() and jacobian_beside() of arm_linearisation.h.
  void (*linearise)(const LinearisedArm& model, double time, const HeldInputs& in, const double* x,
                    const ChainPoint* near, double* x_dot, double* A, LinearisedPoint& point);
  void (*jacobian)(const LinearisedArm& model, double time, const HeldInputs& in, const double* x,
                   const ChainPoint& chain, double* A);
  /// set_changes() of arm_changes.h.
  void (*changes)(const Transmission<Lanes>& transmission, const StateLayout& layout, double time,
                  const CommandHistory* history, const Lanes* command, const Lanes* external, const ChainPoint& chain,
                  const KnownRates& at, int blocks, const Lanes* d, Lanes* changes, double* first_force);
  /// chain_curvature() and mean_curvature() of arm_curvature.h.
  void (*chain_curvature)(const LinearisedArm& model, LinearisedPoint& point, const double* x, const double* x_dot,
                          const double* A, double gamma, int count, int blocks, const Lanes* root);
  void (*mean_curvature)(const LinearisedArm& model, double time, const double* x, const ChainPoint& chain,
                         const LinearisedPoint& point, double gamma, int count, int blocks, const Lanes* root,
                         double* mean);
  /// second_stage(), set_rates_beside(), set_far_excess() and set_near_excess() of arm_second_stage.h.
  void (*second_stage)(const LinearisedArm& model, double time, const LinearisedPoint& start, const double* x,
                       const double* x_2, LinearisedPoint& end, double* D);
  void (*rates_beside)(const LinearisedArm& model, double time, const HeldInputs& in, const double* x, double* x_dot,
                       LinearisedPoint& point);
  void (*far_excess)(const LinearisedArm& model, double time, const LinearisedPoint& start, const LinearisedPoint& end,
                     const double* x_2, double factor, int blocks, const Lanes* d, Lanes* rates);
  void (*near_excess)(const LinearisedArm& model, const LinearisedPoint& start, const LinearisedPoint& at,
                      double factor, int blocks, const Lanes* d, Lanes* rates);
  /// impulse_response() of arm_impulses.h.
  void (*impulse_response)(const LinearisedArm& model, const ImpulseStep& step, int blocks, const Lanes* G,
                           Lanes* Gamma);
};

/// The kernels that this processor can run, the widest first; the last is the generic one.
const std::vector<LaneKernels>& lane_kernels();

}  // namespace halyard
