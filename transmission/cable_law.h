#pragma once
/// A cable's tension as a function of its stretch. Two runs of one cable drive a joint. Their force difference g moves
/// the joint; it is positive if it pulls the joint forward:
///
///   paper        g = k_e (exp(x) - exp(-x)) + 2 b_e x'                        (paper, Eq. 6)
///   exponential  each run T = T_0 exp(±a x), a = k_e / T_0, plus ±b_e x', and T >= 0
///   linear       each run T = T_0 ± k_e x ± b_e x', and T >= 0
///
///   x, x'   stretch of the cable, its rate      m, m/s
///   k_e     stiffness of one run at rest        N/m
///   b_e     damping of one run                  N s/m
///   T_0     tension of each run at rest         N
///
/// All three laws have the slope 2 k_e at rest. Eq. 6 takes the exponential of a length in metres, so it is linear
/// within 1e-6 for a stretch of millimetres. It contains no tension, so under this law a cable never goes slack. In the
/// other two laws a run is slack, with tension zero, where its tension would be negative.

#include "transmission/arm_parameters.h"

namespace halyard {

/// Tension of the run that pulls the joint forward, and of the run that pulls it back, N. Under the paper's law they
/// are T_0 ± g/2, not clamped at zero.
template <class T>
struct RunTensions {
  T forward, backward;
};

/// With another tension T_0 at rest than the joint's.
template <class T>
HALYARD_INLINE RunTensions<T> run_tensions(const JointParameters<T>& j, const T& tension, const T& x, const T& x_dot) {
  const T damping = j.damping * x_dot;
  switch (j.law) {
    case CableLaw::exponential: {
      // The bound keeps an extreme sigma point finite; a real cable breaks long before exp(30).
      const T u = max(T(-30.0), min(T(30.0), T(j.stiffness / tension * x)));
      return {max(T(0.0), T(tension * exp(u) + damping)), max(T(0.0), T(tension * exp(T(-u)) - damping))};
    }
    case CableLaw::linear: {
      const T pull = j.stiffness * x + damping;
      return {max(T(0.0), T(tension + pull)), max(T(0.0), T(tension - pull))};
    }
    case CableLaw::paper: break;
  }
  const T half = j.stiffness * sinh(x) + damping;
  return {tension + half, tension - half};
}

template <class T>
HALYARD_INLINE RunTensions<T> run_tensions(const JointParameters<T>& j, const T& x, const T& x_dot) {
  return run_tensions(j, j.tension, x, x_dot);
}

/// The force difference g, N.
template <class T>
HALYARD_INLINE T cable_force(const JointParameters<T>& j, const T& x, const T& x_dot) {
  if (j.law == CableLaw::paper) return T(2.0) * (j.stiffness * sinh(x) + j.damping * x_dot);
  const RunTensions<T> t = run_tensions(j, x, x_dot);
  return t.forward - t.backward;
}

/// Energy of the two runs at stretch x, J: the integral of g at zero rate (x' = 0) from 0 to x.
double cable_energy(const JointParameters<double>& j, double x);

}  // namespace halyard
