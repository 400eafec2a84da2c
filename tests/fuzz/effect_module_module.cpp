// A module of effects whose table and effects are those of the fuzzer's input.
#include <stdexcept>

#include "plugins/effect_plugin.hpp"
#include "tests/fuzz/reader.h"

namespace {

halyard::fuzzing::Bytes input;
halyard_effect_table table;
std::string compiler;
std::uint32_t layout[std::size(halyard::kEffectLayout)];

class FuzzedEffect : public halyard::EffectOf<FuzzedEffect> {
 public:
  FuzzedEffect()
      : name_(input.text(2)),
        scope_(static_cast<halyard::EffectScope>(input.byte() % 3)),
        states_(static_cast<signed char>(input.byte())) {
    for (int count = input.byte() % 16; count > 0; --count) {
      halyard::EffectParameter p{input.text(70), "1", 0, 0, 0, 0};
      for (double* x : {&p.lower, &p.neutral, &p.typical, &p.upper}) *x = input.number();
      parameters_.push_back(p);
    }
  }
  std::string name() const override { return name_; }
  std::string summary() const override { return "made by a fuzzer"; }
  halyard::EffectScope scope() const override { return scope_; }
  int n_states() const override { return states_; }
  std::vector<halyard::EffectParameter> parameters(const halyard::ArmParameters<double>&,
                                                   halyard::EffectPlace) const override {
    return parameters_;
  }

 private:
  std::string name_;
  halyard::EffectScope scope_;
  int states_;
  std::vector<halyard::EffectParameter> parameters_;
};

void make(std::vector<std::unique_ptr<const halyard::Effect>>& effects) {
  for (int count = input.byte() % 4; count > 0; --count) {
    const std::uint8_t kind = input.byte();
    if (kind == 255) throw std::runtime_error(input.text(1000));
    effects.push_back(kind == 254 ? nullptr : std::make_unique<const FuzzedEffect>());
  }
}

}  // namespace

extern "C" __attribute__((visibility("default"))) void take_input(const std::uint8_t* data, std::size_t size) {
  input = {data, size};
}

extern "C" const halyard_effect_table* halyard_effects() {
  const std::uint8_t kind = input.byte();
  compiler = kind == 1 ? input.text(200) : halyard::kEffectCompiler;
  std::copy(std::begin(halyard::kEffectLayout), std::end(halyard::kEffectLayout), layout);
  if (kind == 2) layout[input.byte() % std::size(layout)] = input.byte();
  table = {std::uint32_t(kind == 3 ? input.byte() : HALYARD_EFFECT_INTERFACE),
           std::uint32_t(kind == 4 ? input.byte() : sizeof table),
           kind == 5 ? nullptr : compiler.c_str(),
           kind == 6 ? nullptr : layout,
           kind == 7 ? input.byte() % std::uint32_t(std::size(layout)) : std::uint32_t(std::size(layout)),
           kind == 8 ? nullptr : make};
  return kind == 9 ? nullptr : &table;
}
