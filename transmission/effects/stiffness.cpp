#include "transmission/effects/library.h"

/// Another stiffness or damping of the cable: k_e' = κ k_e, b_e' = δ b_e.
///
///   κ, δ   ratios to the model's numbers      -
///
/// Source: the paper's Table I gives one value for a cable whose stiffness varies with tension
/// and wear (Miyasaka et al., ICRA 2016).

namespace halyard {
namespace {

class Stiffness : public EffectOf<Stiffness> {
 public:
  std::string name() const override { return "stiffness"; }
  std::string summary() const override { return "another stiffness or damping of the cable"; }
  bool applies(const ArmParameters<double>& arm, int joint) const override {
    return arm.joint[joint].drive == Drive::cable;
  }
  std::vector<EffectParameter> parameters(const ArmParameters<double>& arm, int joint) const override {
    const double tolerance = arm.joint[joint].tolerance.stiffness;
    return {{"stiffness_ratio", "1", 1, 0.8, 0.02, 50, tolerance}, {"damping_ratio", "1", 1, 1, 0.02, 50, tolerance}};
  }

  template <class T>
  void change(ArmParameters<T>& arm, int joint, const T* p) const {
    arm.joint[joint].stiffness *= p[0];
    arm.joint[joint].damping *= p[1];
  }
};

}  // namespace

std::unique_ptr<const Effect> make_stiffness() { return std::make_unique<Stiffness>(); }

}  // namespace halyard
