# docs/studies: each study is one or more sweeps, or a script, with a picture and a table.

sweep_of() { echo "./run sweep docs/studies/$1.xml --out out/$1"; }

# study_lines NAME error|ratio ROW CURVE: what a sweep found, for panels.awk, over its first axis. An empty row or curve
# is the estimator's name. ratio: the error over that of kinematics.
study_lines() {
  ran "$(sweep_of "$1")"
  awk -F , -v what="$2" -v row="$3" -v curve="$4" '
    FNR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    $at["mean_absolute_error"] == "" { next }
    {
      error = $at["mean_absolute_error"]; joint = $at["joint"]; estimator = $at["estimator"]
      if (estimator == "kinematics") rigid[joint] = error
      if (what == "ratio" && estimator == "kinematics") next
      y = what == "ratio" ? error / rigid[joint] : error * ($at["unit"] == "m" ? 1000 : 57.29577951308232)
      printf "%s\tJoint %d\t%s\t%s\t%.9g\n", row == "" ? estimator : row, joint, curve == "" ? estimator : curve, $2, y
    }' "$work/out/$1/sweep.csv"
}

# gain_table HEADER EVERY: the mean gains of the lines of ratios on the standard input, a row for each EVERYth x, and for
# each curve.
gain_table() {
  printf '| %s | estimator | joint 1 | joint 2 | joint 3 |\n|---:|---|---:|---:|---:|\n' "$1"
  awk -F '\t' -v every="$2" '
    { sum[$3, $4, $2] += $5; ++n[$3, $4, $2] }
    !($4 in known) { known[$4] = 1; value[++values] = $4 }
    !($3 in met) { met[$3] = 1; name[++names] = $3 }
    END {
      for (i = 1; i <= values; i += every)
        for (e = 1; e <= names; ++e) {
          printf "| %.3g | `%s`", value[i], name[e]
          for (k = 1; k <= 3; ++k) {
            key = name[e] SUBSEP value[i] SUBSEP "Joint " k
            printf " | %.1f %%", 100 * (1 - sum[key] / n[key])
          }
          print " |"
        }
    }'
}

# Table IV of the paper: mean absolute errors of kinematics and of its UKF on the robot, and their ratio.
paper_errors() {
  printf -- '-error\tJoint %d\t*kinematics, real robot\t1\t%s\n' 1 1.3134 2 2.6383 3 2.507
  printf -- '-error\tJoint %d\t*UKF, real robot (paper, Table IV)\t1\t%s\n' 1 1.2946 2 1.6685 3 0.928
}
paper_ratios() {
  printf -- '-ratio\tJoint %d\t*UKF, real robot (paper, Table IV)\t1\t%s\n' 1 0.98569 2 0.63241 3 0.37016
}

figure study_stiffness_svg minutes
figure_study_stiffness_svg() {
  { study_lines stiffness error -error ''; study_lines stiffness ratio -ratio ''; paper_errors; paper_ratios; } |
    awk -v x_label="stiffness of the three cables, as a multiple of the model's (720, 88, 9.25 kN/m)" \
      -v y_labels='error [deg; joint 3: mm]|error / error of kinematics' -f "$here/panels.awk"
}

figure study_stiffness minutes
figure_study_stiffness() {
  local lines
  lines=$(study_lines stiffness ratio gain '')
  echo "From \`$(sweep_of stiffness)\`: 1 - (error) / (error of kinematics), means over 8 seeds."
  echo
  gain_table stiffness 3 <<<"$lines"
}

figure study_pretension_svg minutes
figure_study_pretension_svg() {
  {
    study_lines pretension ratio known ''
    study_lines pretension_unknown ratio unknown ''
    for row in known unknown; do
      printf '%s\tJoint %d\t|High tension\t1\t1\n' $row 1 $row 2 $row 3
      printf '%s\tJoint %d\t|Low tension of the paper\t%s\t1\n' $row 1 0.5392 $row 2 0.4107 $row 3 0.3325
    done
  } | awk -v x_label="tension of the three cables, as a multiple of High tension (51.0, 43.1, 41.2 N)" \
    -v y_label='error / error of kinematics' -f "$here/panels.awk"
}

figure study_pretension minutes
figure_study_pretension() {
  local which lines
  for which in pretension pretension_unknown; do
    lines=$(study_lines $which ratio gain '')
    echo "From \`$(sweep_of $which)\`: 1 - (error) / (error of kinematics), means over 6 seeds."
    echo
    gain_table tension 4 <<<"$lines"
    echo
  done
}

# The error of the model in tolerances, which are shares of the right value.
in_tolerances() { awk -F '\t' -v OFS='\t' -v tolerance="$1" '{ $4 = sprintf("%.4g", ($4 - 1) / tolerance) } 1'; }

model_error_lines() {
  study_lines model_error_stiffness ratio '' 'stiffness of the cables' | in_tolerances 0.10
  study_lines model_error_friction ratio '' 'friction' | in_tolerances 0.20
  study_lines model_error_mass ratio '' 'masses of the links' | in_tolerances 0.05
  study_lines model_error_radius ratio '' 'radii of the capstans' | in_tolerances 0.005
}

figure study_model_error_svg minutes
figure_study_model_error_svg() {
  model_error_lines | grep -v '^ekf' |
    awk -v x_label='error of the model, in tolerances (stiffness 10 %, friction 20 %, masses 5 %, radii 0.5 %)' \
      -v y_label='error / error of kinematics' -f "$here/panels.awk"
}

figure study_model_error minutes
figure_study_model_error() {
  local which
  echo 'From `./run sweep docs/studies/model_error_WHICH.xml --out out/model_error_WHICH`: 1 - (error) / (error of kinematics).'
  echo
  echo '| wrong by 2 tolerances | estimator | joint 1 | joint 2 | joint 3 |'
  echo '|---|---|---:|---:|---:|'
  model_error_lines | awk -F '\t' '
    $4 != 2 { next }
    !(($3, $1) in met) { met[$3, $1] = 1; row[++rows] = $3 SUBSEP $1 }
    { sum[$3, $1, $2] += $5; ++n[$3, $1, $2] }
    END {
      for (i = 1; i <= rows; ++i) {
        split(row[i], part, SUBSEP)
        printf "| %s | `%s`", part[1], part[2]
        for (k = 1; k <= 3; ++k) printf " | %.1f %%", 100 * (1 - sum[row[i], "Joint " k] / n[row[i], "Joint " k])
        print " |"
      }
    }'
  ran "$(sweep_of model_error_several)"
  for which in ekf sr_ukf disturbance_sr_ukf; do
    printf '| several, within 2: median and worst of 31 | `%s`' $which
    for joint in 1 2 3; do
      study_lines model_error_several ratio '' '' |
        awk -F '\t' -v e=$which -v k="Joint $joint" '$1 == e && $2 == k { print $5 }' | sort -g | awk '{ r[NR] = $1 } END { printf " | %.1f %%, %.1f %%", 100 * (1 - r[(NR + 1) / 2]), 100 * (1 - r[NR]) }'
    done
    echo ' |'
  done
}

study_refinement='docs/studies/refinement.sh out/refinement ./run'

figure study_refinement minutes
figure_study_refinement() {
  ran "$study_refinement"
  echo "From \`$study_refinement\`, which runs \`./run sweep\` with both files: points of a refined"
  echo 'grid, their saving, and the largest error of the even grid. The refined grid interpolates at least as well.'
  echo
  echo '| even grid | stiffness, gain | stiffness, ln(error) | unknown pretension, gain | unknown pretension, ln(error) |'
  echo '|---:|---:|---:|---:|---:|'
  awk -F , '
    FNR == 1 { next }
    !($3 in met) { met[$3] = 1; even[++rows] = $3 }
    { cell[$3, $1, $2] = sprintf("%d, %.0f %% (error %.2g)", $5, 100 * (1 - $5 / $3), $4) }
    END {
      for (i = 1; i <= rows; ++i) {
        printf "| %d", even[i]
        for (s = 1; s <= 2; ++s)
          for (w = 1; w <= 2; ++w)
            printf " | %s", cell[even[i], s == 1 ? "stiffness" : "pretension_unknown", w == 1 ? "gain" : "log_error"]
        print " |"
      }
    }' "$work/out/refinement/refinement.csv"
}

# limit_lines: effect, joint, resolution, noise, limit and naming limit in um or %, of what the study of limits found.
limit_lines() {
  ran "$(sweep_of detection_limits)"
  awk -F , '
    function shown(x) { return x == "" ? "" : sprintf("%.6g", x * ($4 == "backlash" ? 1e6 : 100)) }
    FNR == 1 { next }
    {
      noise = $3 == 0 ? "0" : sprintf("1e%.0f rad", log($3) / log(10) - 3)
      printf "%s,%d,%s,%s,%s,%s\n", $4, $6, $2, noise, shown($8), shown($9)
    }' "$work/out/detection_limits/sweep.csv"
}

figure study_limits_svg minutes
figure_study_limits_svg() {
  limit_lines | sort -s -t , -k 1,1 |
    awk -F , '$5 != "" { printf "%s\tJoint %d\tnoise %s\t%s\t%s\n", $1, $2, $4, $3, $5 }' |
    awk -v x_label='resolution of the joint encoders, as a multiple of the model&#39;s (80000 counts a turn; joint 3: 5 um)' \
      -v y_labels='half gap [um of cable]|share of the cable force [%]' -f "$here/panels.awk"
}

figure study_limits minutes
figure_study_limits() {
  local lines
  lines=$(limit_lines)
  echo "From \`$(sweep_of detection_limits)\`: detection limits, and naming limits in brackets."
  echo
  echo '| resolution | noise | backlash, half gap [um]: joint 1 | joint 2 | joint 3 | hysteresis, share [%]: joint 1 | joint 2 | joint 3 |'
  echo '|---:|---:|---:|---:|---:|---:|---:|---:|'
  awk -F , '
    function digits(x) { return sprintf(x < 999.5 ? "%.3g" : "%.0f", x) }
    !(($3, $4) in met) { met[$3, $4] = 1; row[++rows] = $3 SUBSEP $4 }
    { cell[$3, $4, $1, $2] = ($5 == "" ? "not seen" : digits($5)) ($6 == "" ? "" : " (" digits($6) ")") }
    END {
      for (i = 1; i <= rows; ++i) {
        split(row[i], part, SUBSEP)
        printf "| x%s | %s", part[1], part[2]
        for (k = 1; k <= 3; ++k) printf " | %s", cell[row[i], "backlash", k]
        for (k = 1; k <= 3; ++k) printf " | %s", cell[row[i], "hysteresis", k]
        print " |"
      }
    }' <<<"$lines"
}

# Of the tables of docs/performance.md, which halyard_performance writes: cost beside that of rosenbrock.
integrator_lines() {
  awk -F ' *[|] *' '
    /Moving:$/ { row = "moving" } /^At rest:$/ { row = "at rest" }
    row && $2 == "stiffness" { for (i = 4; i < NF; ++i) name[i] = $i }
    row && $2 ~ /^x[0-9]/ {
      for (i = 4; i < NF; ++i)
        if ($i != "-") printf "%s\tfriction smoothing %s\t%s\t%s\t%.6g\n", row, $3, name[i], substr($2, 2), $i / $4
    }' "$root/docs/performance.md"
}

figure study_integrators_svg seconds
figure_study_integrators_svg() {
  integrator_lines |
    awk -v x_label="stiffness and damping of link 1's cable, as a multiple of the model's" \
      -v y_label='processor time / that of rosenbrock' -v same_y=1 -f "$here/panels.awk"
}
