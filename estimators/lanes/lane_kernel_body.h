/// The kernels of lane_kernels.h, for the instruction set that the including file is compiled for.
/// No include guard: each lanes_<set>.cpp includes it exactly once.

#include "estimators/lanes/lane_kernels.h"
#include "estimators/process/plain/arm_impulses.h"

namespace halyard {
namespace {

/// Calls f<n>() for arms of three joints, those of the RAVEN-II, where the compiler then unrolls the loops over joints,
/// and f<0>() for others, to save compile time. See joint_count().
template <class F>
HALYARD_INLINE void with_known_joints(int n, const F& f) {
  if (n == 3) f.template operator()<3>();
  else f.template operator()<0>();
}

template <class T>
void advance(const Transmission<T>& transmission, const StateLayout& layout, double time, double dt, int substeps,
             const CommandHistory* history, const T* command, const T* external, T* x) {
  const double h = dt / substeps;
  with_known_joints(
      layout.n_joints, [&]<int known>() __attribute__((always_inline)) {
        for (int i = 0; i < substeps; ++i)
          runge_kutta_4<known>(transmission, layout, time + i * h, h, history, command, external, x);
      });
}

// Local to each set. linearised_derivative() is inline: the linker keeps one copy for all sets, and its address would
// lead to that copy. So are the next ones.
void linearise(const LinearisedArm& model, double time, const HeldInputs& in, const double* x, const ChainPoint* near,
               double* x_dot, double* A, LinearisedPoint& point) {
  with_known_joints(
      model.layout.n_joints, [&]<int known>() __attribute__((always_inline)) {
        linearised_derivative<known>(model, time, in, x, near, x_dot, A, point);
      });
}

void jacobian(const LinearisedArm& model, double time, const HeldInputs& in, const double* x, const ChainPoint& chain,
              double* A) {
  with_known_joints(
      model.layout.n_joints, [&]<int known>() __attribute__((always_inline)) {
        jacobian_beside<known>(model, time, in, x, chain, A);
      });
}

void changes(const Transmission<Lanes>& transmission, const StateLayout& layout, double time,
             const CommandHistory* history, const Lanes* command, const Lanes* external, const ChainPoint& chain,
             const KnownRates& at, int blocks, const Lanes* d, Lanes* changes, double* first_force) {
  with_known_joints(
      layout.n_joints, [&]<int known>() __attribute__((always_inline)) {
        set_changes<known>(transmission, layout, time, history, command, external, chain, at, blocks, d, changes,
                           first_force);
      });
}

void chain_curvature(const LinearisedArm& model, LinearisedPoint& point, const double* x, const double* x_dot,
                     const double* A, double gamma, int count, int blocks, const Lanes* root) {
  with_known_joints(
      model.layout.n_joints, [&]<int known>() __attribute__((always_inline)) {
        halyard::chain_curvature<known>(model, point, x, x_dot, A, gamma, count, blocks, root);
      });
}

void mean_curvature(const LinearisedArm& model, double time, const double* x, const ChainPoint& chain,
                    const LinearisedPoint& point, double gamma, int count, int blocks, const Lanes* root,
                    double* mean) {
  with_known_joints(
      model.layout.n_joints, [&]<int known>() __attribute__((always_inline)) {
        halyard::mean_curvature<known>(model, time, x, chain, point, gamma, count, blocks, root, mean);
      });
}

void second_stage(const LinearisedArm& model, double time, const LinearisedPoint& start, const double* x,
                  const double* x_2, LinearisedPoint& end, double* D) {
  with_known_joints(
      model.layout.n_joints, [&]<int known>() __attribute__((always_inline)) {
        halyard::second_stage<known>(model, time, start, x, x_2, end, D);
      });
}

void rates_beside(const LinearisedArm& model, double time, const HeldInputs& in, const double* x, double* x_dot,
                  LinearisedPoint& point) {
  with_known_joints(
      model.layout.n_joints, [&]<int known>() __attribute__((always_inline)) {
        set_rates_beside<known>(model, time, in, x, x_dot, point);
      });
}

void far_excess(const LinearisedArm& model, double time, const LinearisedPoint& start, const LinearisedPoint& end,
                const double* x_2, double factor, int blocks, const Lanes* d, Lanes* rates) {
  with_known_joints(
      model.layout.n_joints, [&]<int known>() __attribute__((always_inline)) {
        set_far_excess<known>(model, time, start, end, x_2, factor, blocks, d, rates);
      });
}

void near_excess(const LinearisedArm& model, const LinearisedPoint& start, const LinearisedPoint& at, double factor,
                 int blocks, const Lanes* d, Lanes* rates) {
  with_known_joints(
      model.layout.n_joints, [&]<int known>() __attribute__((always_inline)) {
        set_near_excess<known>(model, start, at, factor, blocks, d, rates);
      });
}

void impulse_response(const LinearisedArm& model, const ImpulseStep& step, int blocks, const Lanes* G, Lanes* Gamma) {
  with_known_joints(
      model.layout.n_joints, [&]<int known>() __attribute__((always_inline)) {
        halyard::impulse_response<known>(model, step, blocks, G, Gamma);
      });
}

constexpr LaneKernels kernels_named(const char* name) {
  return {name,           advance<Lanes>, advance<Dual>, linearise,  jacobian,    changes,         chain_curvature,
          mean_curvature, second_stage,   rates_beside,  far_excess, near_excess, impulse_response};
}

}  // namespace
}  // namespace halyard
