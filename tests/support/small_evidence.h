#pragma once
/// Evidence of an arm of two joints on a few seconds of motion, without any effect.

#include "diagnosis/fit/evidence.h"
#include "plant/simulate.h"
#include "tests/support/short_arm.h"

namespace halyard {

inline Evidence small_evidence() {
  const ArmModel model = first_joints(2);
  return Evidence(make_records(simulate(motion(model, 6)).measured, model, {}), model);
}

/// Of the first joint alone on two seconds of motion.
inline Evidence brief_evidence() {
  const ArmModel model = first_joints(1);
  return Evidence(make_records(simulate(motion(model, 2)).measured, model, {}), model);
}

/// Of the deciding blocks and all channels.
inline double independent_samples(const Evidence& evidence) {
  double samples = 0;
  for (const std::vector<int>& block : evidence.block_count())
    for (int c = 0; c < evidence.channels(); ++c) samples += block[c] / evidence.correlated_rows(c);
  return samples;
}

}  // namespace halyard
