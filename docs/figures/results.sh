# README.md, docs/results.md and examples/measured: errors before and after.

# A picture for the first page: the estimate's error at joint 2 over the last third of a log, three ways.
figure result_svg seconds
figure_result_svg() {
  local estimate='./run estimate --data examples/raven2/undeclared_effect.csv'
  ran "$diagnose_backlash"
  ran "$estimate --model examples/raven2/raven2.xml --estimator kinematics --out out/picture_kinematics.csv"
  ran "$estimate --model examples/raven2/raven2.xml --estimator sr_ukf --out out/picture_given.csv"
  ran "$estimate --model out/diagnosis/model.xml --estimator sr_ukf --out out/picture_revised.csv"
  awk -F , -v per_rad=$per_rad -f "$here/result_picture.awk" "$work/examples/raven2/undeclared_effect.csv" \
    "$work/out/picture_kinematics.csv" "$work/out/picture_given.csv" "$work/out/picture_revised.csv"
}

# before_after COMMAND PATTERN: "a -> b unit" of the printed line that matches, as "a | b unit" without the arrow.
before_after() {
  printed "$1" | grep -E "$2" | head -n 1 | sed -E 's/.*: ([^ ]+) -> ([^ ]+) (.*)/\1 \3 | \2 \3/'
}

davinci_model='--model examples/measured/davinci_tool/davinci_tool.xml'
davinci_training='--data recordings/davinci_tool/run_L4_00.csv --data recordings/davinci_tool/run_L4_05.csv'
davinci_zero() { echo "--column joint_position_1=jaw_pos_rad,sign=-1,offset=$1"; }

# davinci_before RUN OFFSET: RMS error, rad, of the given model's prediction on a run, with this zero of the jaw. The
# log to learn from is cut to 3 s: the error before does not depend on it.
davinci_before() {
  ran 'head -n 3001 recordings/davinci_tool/run_L4_00.csv > out/davinci_short.csv'
  ran "./run diagnose $davinci_model --data out/davinci_short.csv --holdout recordings/davinci_tool/run_$1.csv \
$(davinci_zero "$2") --out out/davinci_$1_$2"
  grep -A 2 '"joint_position_rms"' "$work/out/davinci_$1_$2/diagnosis.json" | grep -oE '[0-9]+\.[0-9e-]+' | head -n 1
}

# The zero at which the mean error of sr_ukf over both training runs is nil.
davinci_trained_zero() {
  local run sum=0
  for run in L4_00 L4_05; do
    ran "./run compare recordings/davinci_tool/run_$run.csv $davinci_model --estimators sr_ukf --use-joint-torque \
      --out out/davinci_$run"
    sum="$sum + $(value "$work/out/davinci_$run/comparison.csv" bias estimator=sr_ukf)"
  done
  calculate %.5f "1.25 + ($sum) / 2"
}

figure davinci_zero minutes davinci_tool
figure_davinci_zero() {
  local zero given moved d mean best as_given rezeroed
  zero=$(davinci_trained_zero) || return 1
  given=$(davinci_before L4_25 1.25) || return 1
  moved=$(davinci_before L4_25 "$zero") || return 1
  # A zero moved by d changes the mean square error R² to R² + 2 m d + d², with the mean error m.
  d=$(calculate %.8f "$zero - 1.25")
  mean=$(calculate %.8f "($moved ^ 2 - $given ^ 2 - $d ^ 2) / (2 * $d)")
  best=$(calculate %.3g "sqrt($given ^ 2 - ($mean) ^ 2) * $per_rad")
  as_given="${davinci_run}L4_25.csv --out out/davinci_tool"
  rezeroed="${davinci_run}L4_25.csv $(davinci_zero "$zero") --out out/davinci_rezeroed"
  ran "$as_given"
  ran "$rezeroed"
  cat <<TABLE
| zero of the jaw, \`offset\` of \`halyard diagnose --column\` | given model | revised model | named |
|---|---|---|---|
| 1.25 rad, as in the model | $(before_after "$as_given" '^  joint 1 position') | $(named "$as_given") |
| $zero rad, from both training runs | $(before_after "$rezeroed" '^  joint 1 position') | $(named "$rezeroed") |
| $(calculate %.4f "1.25 - ($mean)") rad, the best one for this very run | $best deg | - | - |
TABLE
}

# error_row TEXT COMMAND LINE REZEROED: a row of the table of recordings, from the printed line that matches.
error_row() {
  ran "$2"
  echo "| $1 | $(before_after "$2" "$3" | sed "s/ | / | $4 | /") | $(named "$2") |"
}

# What the verdict names, with the probability of each name, without "effects: ".
named() {
  printed "$1" | sed -nE '/^(clean|effects:|unknown)/ { s/^effects: //; p; q }'
}

# three_torques FIELD: the errors of the RAVEN-II's motor torques before (1) or after (3) the arrow.
three_torques() {
  printed "$raven2_log" | sed -nE 's/^  joint [123] motor torque RMS on the hold-out: //p' | cut -d ' ' -f "$1" |
    paste -sd , | sed 's/,/, /g'
}

raven2_log='./run diagnose --model examples/measured/raven2_motor_log/raven2.xml \
    --data recordings/raven2_motor_log/run_joints123.csv --out out/raven2_motor_log'
davinci_run="./run diagnose $davinci_model \\
    $davinci_training \\
    --holdout recordings/davinci_tool/run_"
kuka_axis_2='./run diagnose --model examples/measured/kuka_kr300/axis2.xml \
    --data recordings/kuka_kr300/traj_A_axis2.csv --holdout recordings/kuka_kr300/traj_B_axis2.csv --out out/kuka_axis2'
emps_run='./run diagnose --model examples/measured/emps/emps.xml --data recordings/emps/data_emps.csv \
    --holdout recordings/emps/data_emps_pulses.csv --out out/emps'

figure recordings minutes raven2_motor_log davinci_tool kuka_kr300 emps
figure_recordings() {
  local zero pitch speed
  zero=$(davinci_trained_zero) || return 1
  speed=$(davinci_before L4_25 "$zero") || return 1
  pitch=$(davinci_before pitch0_003 "$zero") || return 1
  cat <<'TABLE'
| recording | given model | re-zeroed | revised model | named by `./run diagnose` |
|---|---|---|---|---|
TABLE
  error_row 'da Vinci Si tool, jaw angle, at three times the speed of the training runs' \
    "${davinci_run}L4_25.csv --out out/davinci_tool" \
    '^  joint 1 position' "$(calculate %.3g "$speed * $per_rad") deg"
  error_row 'da Vinci Si tool, jaw angle, another pose of the wrist' \
    "${davinci_run}pitch0_003.csv --out out/davinci_pitch" \
    '^  joint 1 position' "$(calculate %.3g "$pitch * $per_rad") deg"
  ran "$raven2_log"
  echo "| RAVEN-II, torques of motors 1, 2 and 3 | $(three_torques 1) mN m | - | $(three_torques 3) mN m |" \
    "$(named "$raven2_log") |"
  error_row 'KUKA KR300, link angle of axis 2, another path' "$kuka_axis_2" '^  joint 1 position' '-'
  error_row 'EMPS ball-screw axis, force, with pulses' "$emps_run" '^  joint 1 motor (torque|force)' '-'
}

# Logs of the independent simulator: folder, joint, and what its robot has.
rig_logs=(
  'clean-1|2|none' 'clean-2|2|none' 'capstan_ratio-j1|1|capstan of joint 1 larger by 5.64 %'
  'coupling-j2|2|coupling C01 larger by 0.035' 'backlash-j2|2|dead zone of ±0.35 mm at joint 2'
  'pulley_friction-j2|2|pulley friction 0.1 at joint 2, half on each side' 'payload|3|payload of 100 g'
  'hysteresis-j3|3|55 % of the stiffness of cable 3 in elastic-plastic sliders' 'stiffness-j3|3|cable 3 with 40 % of its stiffness'
)

rig_log_command() {
  echo "./run diagnose --model examples/raven2/raven2.xml --data recordings/rig/$1/train.csv \\
    --holdout recordings/rig/$1/holdout.csv --out out/rig/$1"
}

figure rig_logs minutes rig
figure_rig_logs() {
  local row folder joint truth command
  cat <<'TABLE'
From `./run diagnose` as above:

| the robot's effect | `halyard diagnose` names | numbers | joint | given model | revised model |
|---|---|---|---|---|---|
TABLE
  for row in "${rig_logs[@]}"; do
    IFS='|' read -r folder joint truth <<<"$row"
    command=$(rig_log_command "$folder")
    ran "$command"
    echo "| $truth | $(named "$command") | $(found_numbers "$command") | $joint |" \
      "$(before_after "$command" "^  joint $joint position") |"
  done
}

# "half_gap 0.000351 m, ..." of the named effects, without intervals.
found_numbers() {
  local numbers
  numbers=$(printed "$1" | grep -E '^  [a-z_]+ of (joint [0-9]|the arm) [a-z_0-9]+: |^  payload mass: ' |
    sed -E 's/^ .* ([a-z_0-9]+): ([^(]*) \(95 %.*/\1 \2/; s/ 1$//' | paste -sd , | sed 's/,/, /g')
  echo "${numbers:--}"
}

figure rig_estimators minutes rig
figure_rig_estimators() {
  local row folder joint truth command k name cells
  cat <<'TABLE'
From `./run diagnose` as above:

| the robot's effect | kinematics, given model | revised | `sr_ukf`, given model | revised |
|---|---|---|---|---|
TABLE
  for row in "${rig_logs[@]}"; do
    IFS='|' read -r folder joint truth <<<"$row"
    command=$(rig_log_command "$folder")
    ran "$command"
    [ "$truth" != none ] || continue  # nothing is revised
    cells=
    for name in kinematics sr_ukf; do
      for k in 1 3; do  # 1: before, 3: after the arrow
        cells+=" | $(printed "$command" | sed -nE "s/^  joint [0-9] $name position RMS on the hold-out: //p" |
          cut -d ' ' -f $k | while read -r error; do calculate '%.3g\n' "$error"; done | paste -sd , | sed 's/,/, /g')"
      done
    done
    echo "| $truth$cells |"
  done
}
