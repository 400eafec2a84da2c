#include "spring_effect.h"

class RefiningSpring : public Spring, public halyard::RefinesSearch {
 public:
  std::string name() const override { return "fixture_refining_spring"; }
  void refine_search(halyard::SearchSpace& space, const halyard::ArmParameters<double>&,
                     halyard::EffectPlace) const override {
    space["stiffness"].starts = {1, 10};
  }
};

extern "C" const halyard_effect_table* halyard_effects() {
  static const auto table = halyard::effect_table<RefiningSpring>();
  return &table;
}
