#include "transmission/effects/built_in.h"

/// The base is not level: gravity is turned about the two base axes a, b (in the order x, y, z) that are most nearly
/// perpendicular to the model's gravity,
///
///   g' = R_a(α) R_b(β) g
///
///   α, β      angles: two of `about_x`, `about_y`, `about_z`      rad
///   R_a, R_b  rotations about fixed base axes, exact
///
/// A rotation about gravity itself changes nothing, so two angles suffice.

namespace halyard::effects {
namespace {

/// The base axis along which gravity is strongest, the first of equals: the one that is left out.
template <class T>
int vertical_axis(const ArmParameters<T>& arm) {
  if (arm.vertical_axis >= 0) return arm.vertical_axis;
  int vertical = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(value(arm.gravity[i])) > std::abs(value(arm.gravity[vertical]))) vertical = i;
  return vertical;
}

template <class T>
void turn(T* g, int axis, const T& angle) {
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  const T c = cos(angle), s = sin(angle), gj = g[j];
  g[j] = c * gj - s * g[k];
  g[k] = s * gj + c * g[k];
}

}  // namespace

class GravityTilt : public EffectOf<GravityTilt> {
 public:
  std::string name() const override { return "gravity_tilt"; }
  std::string summary() const override { return "the base is not level: gravity points another way"; }
  EffectScope scope() const override { return EffectScope::arm; }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, EffectPlace) const override {
    std::vector<EffectParameter> all;
    for (int axis = 0; axis < 3; ++axis)
      if (axis != vertical_axis(arm)) all.push_back({std::string("about_") + "xyz"[axis], "rad", 0, 0.03, -0.5, 0.5});
    return all;
  }

  template <class T>
  void change(ArmParameters<T>& arm, EffectPlace, const T* p) const {
    const int vertical = arm.vertical_axis = vertical_axis(arm);
    turn(arm.gravity, vertical == 2 ? 1 : 2, p[1]);
    turn(arm.gravity, vertical == 0 ? 1 : 0, p[0]);
  }
};

HALYARD_EFFECT(GravityTilt)

}  // namespace halyard::effects
