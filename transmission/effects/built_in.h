#pragma once
/// Each effect's file ends with this line. It defines the function that creates the file's effect:
///
///   HALYARD_EFFECT(Backlash)
///
/// library.cpp calls this function, so a new effect needs its own file and one line in library.cpp.
///
/// With HALYARD_WIDE_EFFECTS the file is compiled three times. The two further times HALYARD_EFFECT_SET is the name of
/// an instruction set (lanes/instruction_set.h), and only the effect's code over Dual and Lanes is left. The function
/// above creates effects with the code of the widest set that the processor has. Everything in this code has to be
/// inlined: other files may not call it, and a value of type Lanes is passed in other registers in each set.

#include "transmission/effect.h"
#include "transmission/lanes/instruction_set.h"

namespace halyard::effects {

namespace {
template <class E, class T>
[[gnu::flatten]] void act_of(const Effect& e, EffectStage stage, const EffectContext<T>& c, JointSignals<T>* s) {
  static_cast<const E&>(e).act_at(stage, c, s);
}
template <class E, class T>
[[gnu::flatten]] void rates_of(const Effect& e, const EffectContext<T>& c, const JointSignals<T>* s, T* z_dot) {
  static_cast<const E&>(e).state_rate(c, s, z_dot);
}
template <class E>
constexpr WideCode kWideCode = {{act_of<E, Dual>, rates_of<E, Dual>}, {act_of<E, Lanes>, rates_of<E, Lanes>}};
}  // namespace

#if defined(HALYARD_EFFECT_SET)
#define HALYARD_CODE_OF_SET(E, set) HALYARD_CODE_OF_SET_(E, set)
#define HALYARD_CODE_OF_SET_(E, set)  \
  extern const WideCode k##E##_##set; \
  const WideCode k##E##_##set = kWideCode<E>;
#define HALYARD_EFFECT(E) HALYARD_CODE_OF_SET(E, HALYARD_EFFECT_SET)
#else
template <class E>
std::unique_ptr<const Effect> make_effect() {
  auto effect = std::make_unique<E>();
  effect->use(code_of(effect.get()));
  return effect;
}
#if defined(HALYARD_WIDE_EFFECTS)
#define HALYARD_EFFECT(E)                                                             \
  extern const WideCode k##E##_avx2, k##E##_avx512;                                   \
  static WideCode code_of(const E*) {                                                 \
    static constexpr WideCode generic = kWideCode<E>;                                 \
    return usable_copies<WideCode>({&generic, &k##E##_avx2, &k##E##_avx512}).front(); \
  }                                                                                   \
  template std::unique_ptr<const Effect> make_effect<E>();
#else
#define HALYARD_EFFECT(E)                                    \
  static WideCode code_of(const E*) { return kWideCode<E>; } \
  template std::unique_ptr<const Effect> make_effect<E>();
#endif
#endif

}  // namespace halyard::effects
