# docs/commands.md and the README's transcript: what each command prints.

fenced() { echo '```' && "$@" && echo '```'; }

readonly simulate_a='./run simulate examples/raven2/experiment_a.xml --out out/a.csv'
readonly diagnose_backlash='./run diagnose --model examples/raven2/raven2.xml \
    --data examples/raven2/undeclared_effect.csv --out out/diagnosis'

figure simulate seconds
figure_simulate() { fenced transcript "$simulate_a" 'scenario|joint|log:|truth:'; }

figure estimate seconds
figure_estimate() {
  ran "$simulate_a"
  fenced transcript './run estimate --model examples/raven2/raven2.xml --estimator sr_ukf --data out/a.csv \
    --out out/a_estimate.csv' 'sr_ukf|joint|estimates:'
}

figure compare seconds
figure_compare() {
  fenced transcript './run compare examples/raven2/experiment_a.xml --estimators kinematics,ekf,sr_ukf \
    --out out/compare' \
    '^(kinematics|ekf|sr_ukf)|joint 2|report:'
}

figure diagnose seconds
figure_diagnose() {
  fenced transcript "$diagnose_backlash" '^effects|half_gap:|joint 2 (kinematics |sr_ukf )?position|model:|report:'
}

figure rehearse minutes
figure_rehearse() {
  fenced transcript "$diagnose_backlash --rehearse 20" '^effects|^  rehearsed|^    '
}

figure identify seconds
figure_identify() {
  local simulate='./run simulate examples/raven2/identification_high_tension.xml --out out/high.csv'
  echo '```'
  echo "\$ $simulate"
  ran "$simulate"
  transcript './run identify --model examples/raven2/raven2_exponential.xml --data out/high.csv --parameters coupling \
    --out out/identify' 'coupling|sr_ukf|model:|report:'
  echo '```'
}

figure plan minutes
figure_plan() {
  fenced transcript './run diagnose --plan examples/raven2/raven2.xml examples/raven2/undeclared_effect.xml \
    --separate gravity_tilt,joint_friction@2 --out out/plan' \
    '^effect |^gravity_tilt|^backlash +2|^scenario|^report'
}

figure sweep minutes
figure_sweep() {
  fenced transcript './run sweep examples/raven2/stiffness_sweep.xml --out out/sweep' 'sweep|table:|report:'
}

figure check seconds
figure_check() {
  local misspell="sed 's/ stiffness=/ stifness=/' examples/raven2/raven2.xml > out/bad.xml"
  echo '```'
  transcript './run check examples/raven2/raven2.xml' '.'
  echo "\$ $misspell"
  ran "$misspell"
  refusal './run check out/bad.xml'
  echo '```'
}

figure plugins seconds
figure_plugins() { fenced transcript './run plugins' '.'; }
