# READMEs of the plug-ins: errors on the RAVEN-II's scenarios.

# errors_table DIR ESTIMATORS...: RMS errors by joint of a comparison's comparison.csv, one column an estimator.
errors_table() {
  local joint name header='|' rule='|---' line
  for name in "${@:2}"; do header+=" | \`$name\`"; rule+='|---'; done
  echo "$header |"
  echo "$rule|"
  for joint in 1 2 3; do
    line="| joint $joint"
    for name in "${@:2}"; do
      line+=" | $(shown_error "$(value "$work/$1/comparison.csv" rms_error estimator="$name" joint=$joint)" $joint)"
    done
    echo "$line |"
  done
}

shown_error() {
  if [ "$2" -lt 3 ]; then calculate '%.3g deg' "$1 * $per_rad"; else calculate '%.3g mm' "$1 * 1000"; fi
}

figure camera seconds
figure_camera() {
  local command='./run compare examples/raven2/camera.xml --estimators kinematics,sr_ukf,camera_sr_ukf --out out/camera'
  ran "$command"
  echo "RMS errors after 0.5 s, from \`$command\`:"
  echo
  errors_table out/camera kinematics sr_ukf camera_sr_ukf
}

figure smoother minutes
figure_smoother() {
  local command='./run compare examples/raven2/experiment_a.xml --estimators sr_ukf,smoother --noise 1 --runs 4'
  command+=' --out out/smoother'
  ran "$command"
  echo "RMS errors over four seeds, from \`$command\`:"
  echo
  echo '| | `sr_ukf` | `smoother` |'
  echo '|---|---|---|'
  printed "$command" | awk '
    / runs$/ { runs = 1; next }
    !runs { next }
    /: [0-9]+ failed$/ { name = $1; sub(/:/, "", name); next }
    /^  joint/ { joint = $2; sub(/:/, "", joint); unit = $5; sub(/,/, "", unit); error[joint, name] = $4 " " unit }
    END { for (j = 1; j <= 3; ++j) print "| joint " j " | " error[j, "sr_ukf"] " | " error[j, "smoother"] " |" }'
}

# force_errors ESTIMATE.csv: RMS error of joint_force_k in percent of the force, while the force acts, and the same from
# 0.5 s after the onset on. The forces are those of examples/raven2/disturbance.xml.
force_errors() {
  awk -F , '
    /^#/ { next }
    !header { for (i = 1; i <= NF; ++i) at[$i] = i; header = 1; next }
    {
      t = $at["time"]
      for (k = 1; k <= 3; ++k) {
        force = k == 3 ? 15 : 1.5; onset = 3 * k - 1
        if (t < onset || t >= onset + 2) continue
        e = ($at["joint_force_" k] / force - 1) ^ 2
        all[k] += e; ++n[k]
        if (t >= onset + 0.5) { late[k] += e; ++m[k] }
      }
    }
    function percent(square, count) { return 100 * sqrt(square / count) }
    END { for (k = 1; k <= 3; ++k) printf "%.1f %%; %.1f %%\n", percent(all[k], n[k]), percent(late[k], m[k]) }' "$1"
}

figure disturbance seconds
figure_disturbance() {
  local motion joint=1 still moving forces=('' 'joint 1, 1.5 N m' 'joint 2, 1.5 N m' 'joint 3, 15 N')
  ran "sed 's/kind=\"sines\"/kind=\"hold\"/; /<sine /d; s#model=\"#model=\"../examples/raven2/#' \
    examples/raven2/disturbance.xml > out/still.xml"
  ran "cp examples/raven2/disturbance.xml examples/raven2/raven2.xml out/"
  for motion in disturbance still; do
    ran "./run simulate out/$motion.xml --out out/$motion.csv"
    ran "./run estimate --model examples/raven2/raven2.xml --estimator disturbance_sr_ukf --data out/$motion.csv \
      --out out/${motion}_forces.csv"
  done
  cat <<'TABLE'
From `./run simulate examples/raven2/disturbance.xml --out out/forces.csv` and `./run estimate --model
examples/raven2/raven2.xml --estimator disturbance_sr_ukf --data out/forces.csv --out out/forces_estimate.csv`. For
standing still, the same scenario with `kind="hold"`:

| force | standing still | moving |
|---|---|---|
TABLE
  paste -d '|' <(force_errors "$work/out/still_forces.csv") <(force_errors "$work/out/disturbance_forces.csv") |
    while IFS='|' read -r still moving; do
      echo "| ${forces[$joint]} | $still | $moving |"
      joint=$((joint + 1))
    done
}
