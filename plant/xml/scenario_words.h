#pragma once
/// Words for non-numeric values in scenario files; the reader and the writer share them.

#include "model/xml/arm_words.h"
#include "plant/scenario.h"

namespace halyard {

inline const Words<Engine>& words_of(Engine) {
  static const Words<Engine> words = {{"simbody", Engine::simbody}, {"halyard", Engine::halyard}};
  return words;
}

inline const Words<JointTrajectory::Kind>& words_of(JointTrajectory::Kind) {
  using Kind = JointTrajectory::Kind;
  static const Words<Kind> words = {{"hold", Kind::hold},
                                    {"sines", Kind::sines},
                                    {"point_to_point", Kind::point_to_point},
                                    {"samples", Kind::samples}};
  return words;
}

/// All but the automatic choice, which a file makes by leaving the treatment out.
inline const Words<IntegratorKind>& words_of(IntegratorKind) {
  static const Words<IntegratorKind> words = {{"rosenbrock", IntegratorKind::rosenbrock},
                                              {"dirk", IntegratorKind::dirk},
                                              {"imex", IntegratorKind::imex},
                                              {"imex_link1", IntegratorKind::imex_link1},
                                              {"bdf", IntegratorKind::bdf},
                                              {"explicit_rk", IntegratorKind::explicit_rk},
                                              {"simbody_rkm", IntegratorKind::simbody_rkm},
                                              {"simbody_cpodes", IntegratorKind::simbody_cpodes}};
  return words;
}

}  // namespace halyard
