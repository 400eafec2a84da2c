# docs/experiments.md: the paper's experiments, simulated.

readonly experiments_command='./run experiments --out out/experiments'

# Rows of experiments.csv for awk; "NAME, calibrated", which has a comma, becomes NAME calibrated.
experiment_rows() {
  sed -E 's/"([a-z_]+), calibrated"/\1 calibrated/' "$work/out/experiments/experiments.csv" |
    awk -F , -v per_rad=$per_rad "$1"
}

figure experiments minutes
figure_experiments() {
  ran "$experiments_command"
  echo "Mean of A, B and C, from \`$experiments_command\`; improvement over kinematics in brackets:"
  echo
  echo '| | joint 1 | joint 2 | joint 3 |'
  echo '|---|---|---|---|'
  experiment_rows '
    /^#/ { next }
    !header { for (i = 1; i <= NF; ++i) at[$i] = i; header = 1; next }
    {
      e = $at["estimator"]; j = $at["joint"]
      if (!(e in seen)) { seen[e] = 1; order[++n] = e }
      sum[e, j] += $at["mean_absolute_error"] * ($at["unit"] == "rad" ? per_rad : 1000) / 3
    }
    END {
      shown["kinematics"] = "kinematics"; shown["ekf"] = "EKF"; shown["sr_ukf"] = "square-root UKF"
      for (i = 1; i <= n; ++i) {
        name = order[i]; base = name; sub(/ calibrated/, "", base)
        line = "| simulated, " shown[base] (name != base ? ", calibrated" : "") " |"
        for (j = 1; j <= 3; ++j) {
          gain = 1 - sum[name, j] / sum["kinematics", j]
          line = line sprintf(" %.3f %s%s |", sum[name, j], j < 3 ? "deg" : "mm",
                              name == "kinematics" ? "" : sprintf(" (%.1f %%)", 100 * gain))
        }
        print line
      }
    }'
  echo '| robot, kinematics (paper, Table IV) | 1.313 deg | 2.638 deg | 2.507 mm |'
  echo '| robot, UKF (paper, Table IV) | 1.295 deg (1.4 %) | 1.669 deg (36.8 %) | 0.928 mm (63.0 %) |'
}

figure experiments_one_by_one minutes
figure_experiments_one_by_one() {
  ran "$experiments_command"
  echo "From \`$experiments_command\`; each cell is mean absolute error / RMS / peak, in deg, for joint 3 in mm:"
  echo
  echo '| joint | | kinematics | kinematics, calibrated | UKF | UKF, calibrated |'
  echo '|---|---|---|---|---|---|'
  experiment_rows '
    /^#/ { next }
    !header { for (i = 1; i <= NF; ++i) at[$i] = i; header = 1; next }
    {
      scale = $at["unit"] == "rad" ? per_rad : 1000
      x = substr($at["experiment"], 1, 1)
      cell[$at["joint"], x, $at["estimator"]] = sprintf("%.3f / %.3f / %.3f", scale * $at["mean_absolute_error"],
        scale * $at["rms_error"], scale * $at["peak_error"])
    }
    END {
      for (j = 1; j <= 3; ++j)
        for (k = 1; k <= 3; ++k) {
          x = substr("ABC", k, 1)
          print "| " j " | " x " | " cell[j, x, "kinematics"] " | " cell[j, x, "kinematics calibrated"] " | " \
            cell[j, x, "sr_ukf"] " | " cell[j, x, "sr_ukf calibrated"] " |"
        }
    }'
}

figure effect_study minutes
figure_effect_study() {
  ran "$experiments_command"
  echo "Mean absolute errors, mean of A, B and C, from \`$experiments_command\` (\`effects.csv\`):"
  echo
  echo '| effects of the robot | kinematics: joint 1, deg | 2, deg | 3, mm | UKF: joint 1, deg | 2, deg | 3, mm |'
  echo '|---|---|---|---|---|---|---|'
  awk -F , -v per_rad=$per_rad '
    /^#/ { next }
    !header { for (i = 1; i <= NF; ++i) at[$i] = i; header = 1; next }
    {
      e = $at["effects"]
      if (!(e in seen)) { seen[e] = 1; order[++n] = e }
      error[e, $at["estimator"], $at["joint"]] = $at["mean_absolute_error"] * ($at["unit"] == "rad" ? per_rad : 1000)
    }
    END {
      for (i = 1; i <= n; ++i) {
        line = "| " order[i]
        for (k = 1; k <= 6; ++k)
          line = line sprintf(" | %.3g", error[order[i], k < 4 ? "kinematics" : "sr_ukf", (k - 1) % 3 + 1])
        print line " |"
      }
    }' "$work/out/experiments/effects.csv"
}
