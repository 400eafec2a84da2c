#pragma once
/// The arms of trials. Each stands for a model file that a user wrote with care: all its parameters are those of the
/// arm, until recording.h moves the arm's away from them.
///
///   raven2   examples/raven2/raven2.xml
///   random   1 to 7 joints on cables, one in five prismatic, at random angles to each other
///   geared   1 to 6 revolute joints with gears: rigid ones, or (half of the arms) elastic ones, which the model
///            describes as cables on radii of 1
///   mixed    raven2 half of the time, each of the others a quarter
///
/// Random and geared arms are sized from their links: what a motor has to carry is the weight beyond its joint, at full
/// stretch. Ratios, frictions, rotors, stiffnesses and controllers follow from that load by factors that are typical
/// of RAVEN-II, and scatter:
///
///   quantity                      random                  geared, where different
///   link length                   0.1 to 0.25 m; mass 0.3 to 0.9 kg, each link half the one before
///   joint turns per motor turn    1/60 to 1/150           1/50 to 1/150
///   rotor, at the joint           0.3 to 1 of the link's inertia
///   Coulomb friction of the motor, at the joint   5 to 20 % of the load; of the joint 5 to 15 %
///   link against cable            7 to 20 Hz, damping 0.03 to 0.15      15 to 40 Hz
///   encoders                      motor 4000 counts per turn; joint 80000 per turn, 5 um

#include "bench/diagnosis/results/situation.h"
#include "diagnosis/rehearsal/random.h"
#include "model/arm_model.h"

namespace halyard::blind {

/// Its name says what was drawn. `raven2`: the model of that name.
ArmModel draw_arm(Arms arms, const ArmModel& raven2, Random& random);

}  // namespace halyard::blind
