# The ladder of examples: halyard_example(NAME LINE COMPONENT...). NAME.cpp needs these components of halyard, and its
# output has to match LINE. Whoever includes this list says what halyard_example() does.
halyard_example(01_coupling "power balances: yes" plant estimators)
halyard_example(02_cable_laws "slack beyond 0\\.201 mm: the backward run carries 0\\.0 N" plant estimators)
halyard_example(03_hold_against_gravity "largest stretch: 0\\.04 deg, 0\\.23 deg, 0\\.22 mm" plant estimators)
halyard_example(04_follow_a_sine "energy is accounted for: yes" plant estimators)
halyard_example(05_naive_kinematics "it is the cables' stretch: yes" plant estimators)
halyard_example(06_square_root_ukf "the filter is closer than kinematics at joints: 1 2 3" plant estimators)
halyard_example(07_own_effect "knowing the spring helps at joint 2: yes" plant estimators)
halyard_example(08_compare_plugins "sr_ukf .*joint 2 0\\.000" plant plugins)
halyard_example(09_stiffness_sweep "a softer cable is worse for kinematics: yes" plant estimators)
halyard_example(10_tension_sweep "less tension brings the cable closer to slack: yes" plant estimators)
halyard_example(11_close_the_loop "true: backlash, .*found and nothing else: yes" plant diagnosis)
halyard_example(12_live_loop "the filter is closer than kinematics at joints: 1 2 3" plant estimators)
