#include "transmission/effects/built_in.h"

/// A point mass m at the tool. It changes the last link's mass, centre of mass and inertia:
///
///   M' = M + m,  c' = (M c + m r) / M',  I' = I + μ (|d|² E - d dᵀ),  μ = M m / M',  d = r - c
///
///   r   the model's payload point, in the last link's frame     m
///
/// Source: parallel axis theorem for two bodies.

namespace halyard::effects {

class Payload : public EffectOf<Payload> {
 public:
  std::string name() const override { return "payload"; }
  std::string summary() const override { return "a point mass at the tool"; }
  EffectScope scope() const override { return EffectScope::arm; }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace) const override {
    const JointParameters<double>& last = arm.joint[arm.n - 1];
    const double whole = std::max(last.mass, 1e-3);
    double links = 0;
    for (int k = 0; k < arm.n; ++k) links += arm.joint[k].mass;
    return {{"mass", "kg", 0, 0.1 * whole, -0.9 * whole, std::max(20 * whole, links)}};
  }

  template <class T>
  void change(ArmParameters<T>& arm, EffectPlace, const T* p) const {
    JointParameters<T>& last = arm.joint[arm.n - 1];
    // A link without mass stays as it is without a payload.
    const T total = last.mass + p[0], divisor = select(abs(p[0]) > T(0.0), total, T(1.0));
    const T reduced = last.mass * p[0] / divisor;
    T d[3];
    for (int i = 0; i < 3; ++i) {
      d[i] = arm.payload_point[i] - last.com[i];
      last.com[i] += p[0] / divisor * d[i];
    }
    last.inertia[0] += reduced * (d[1] * d[1] + d[2] * d[2]);
    last.inertia[1] += reduced * (d[0] * d[0] + d[2] * d[2]);
    last.inertia[2] += reduced * (d[0] * d[0] + d[1] * d[1]);
    last.inertia[3] -= reduced * d[0] * d[1];
    last.inertia[4] -= reduced * d[0] * d[2];
    last.inertia[5] -= reduced * d[1] * d[2];
    last.mass = total;
  }
};

HALYARD_EFFECT(Payload)

}  // namespace halyard::effects
