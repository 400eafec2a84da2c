#pragma once
/// Every integrator with its name, for the messages of tests.

#include <map>
#include <string>

#include "plant/scenario.h"

namespace halyard {

inline const std::map<IntegratorKind, std::string>& integrator_names() {
  static const std::map<IntegratorKind, std::string> all = {{IntegratorKind::rosenbrock, "rosenbrock"},
                                                            {IntegratorKind::dirk, "dirk"},
                                                            {IntegratorKind::imex, "imex"},
                                                            {IntegratorKind::imex_link1, "imex_link1"},
                                                            {IntegratorKind::bdf, "bdf"},
                                                            {IntegratorKind::explicit_rk, "explicit_rk"},
                                                            {IntegratorKind::simbody_rkm, "simbody_rkm"},
                                                            {IntegratorKind::simbody_cpodes, "simbody_cpodes"}};
  return all;
}

}  // namespace halyard
