# Studies that take hours: noise over many seeds, blind trials, coverage of intervals.

noise_row() {  # TEXT COMMAND RUNS
  local cells
  ran "$2"
  cells=$(printed "$2" | awk '
    / runs$/ { runs = 1; next }
    runs && /: [0-9]+ failed$/ { on = $1 == "sr_ukf:"; if (on) line = $2; next }
    runs && on && /^  joint/ && match($0, /NEES [^,]*, [^ ]* ?%?/) {
      line = line " | " substr($0, RSTART + 5, RLENGTH - 5)
    }
    END { print line }')
  echo "| $1 | $3 | $cells |"
}

figure noise_runs hours
figure_noise_runs() {
  local options='--estimators ekf,sr_ukf' seeds
  local a='./run compare examples/raven2/experiment_a.xml' a_201='./run compare out/experiment_a_201.xml'
  seeds="sed 's/seed=\"[0-9]*\"/seed=\"201\"/; s#model=\"#model=\"../examples/raven2/#' \
examples/raven2/experiment_a.xml > out/experiment_a_201.xml"
  ran "$seeds"
  cat <<'TABLE'
From `halyard compare examples/raven2/experiment_a.xml --estimators ekf,sr_ukf --noise N --runs R --out out/noise`, with
`seed="201"` in the scenario for the second row:

| | runs | failed | joint 1: NEES, instants in band | joint 2 | joint 3 |
|---|---:|---:|---|---|---|
TABLE
  noise_row '`--noise 1`, seeds 1 to 200' "$a $options --noise 1 --runs 200 --out out/noise_1" 200
  noise_row '`--noise 1`, seeds 201 to 400' "$a_201 $options --noise 1 --runs 200 --out out/noise_201" 200
  noise_row '`--noise 10`' "$a $options --noise 10 --runs 20 --out out/noise_10" 20
  noise_row '`--noise 0.1`' "$a $options --noise 0.1 --runs 20 --out out/noise_01" 20
}

# draw_trials SEED OFF FOLDER: runs the trials that stdin lists as "NUMBER KINDS SENSORS", and prints how they were
# counted. Trials in docs/figures/draws/SEED.jsonl are not run again; it has the new ones, too, after this.
draw_trials() {
  local trials kinds sensors kept=docs/figures/draws/$1.jsonl known= new=$3
  [ ! -f "$work/$kept" ] || known=$kept
  while read -r trials kinds sensors; do
    kinds="--kind ${kinds//,/ --kind }" sensors="--sensors ${sensors//,/ --sensors }"
    ran "bench/halyard_blind_trials $kinds $sensors --off $2 --arms raven2 --trials $trials --seed $1 ${known:+--known $known} \
--resume --out $3"
  done
  [ -d "$work/$3/trials" ] || new=
  ran "bench/halyard_blind_trials --summary $known $new --out $3"
  [ $mode = check ] || cp "$work/$3/trials.jsonl" "$root/$kept"
  echo
  awk '/^## /{ inside = $2 == "Acceptance" } inside && /^[|]/' "$work/$3/summary.md"
}

figure blind_trials hours bench
figure_blind_trials() {
  cat <<'TABLE'
From `halyard_blind_trials --seed 20271501 --arms raven2 --off 1 --kind KIND --sensors SENSORS --trials N --out DIR`; N
is 30 for clean arms and one effect, 16 for the other kinds (15 for three effects with poor sensors). There are motors
only for clean arms and one effect:
TABLE
  draw_trials 20271501 1 out/trials <<'DRAWS'
30 clean,effect good,poor,motors
16 two_at_joint,form,outside good,poor
16 three good
15 three poor
DRAWS
}

figure blind_trials_off hours bench
figure_blind_trials_off() {
  cat <<'TABLE'
From `halyard_blind_trials --seed 20271215 --arms raven2 --off 2 --kind KIND --sensors SENSORS --trials N --out DIR`; N is
15 for one effect, 6 for the other kinds:
TABLE
  draw_trials 20271215 2 out/trials_off <<'DRAWS'
15 effect good,poor,motors
6 two_at_joint,three good,poor
DRAWS
}

figure coverage hours bench
figure_coverage() {
  echo 'From `halyard_identify_coverage --runs 50 --seconds 12 --seed 11`, where all other parameters are exact:'
  echo
  ran "bench/halyard_identify_coverage --runs 50 --seconds 12 --seed 11"
  printed "bench/halyard_identify_coverage --runs 50 --seconds 12 --seed 11"
}

figure coverage_off hours bench
figure_coverage_off() {
  local off
  for off in stiffness everything; do
    echo "From \`halyard_identify_coverage --runs 20 --seconds 12 --seed 11 --off $off\`:"
    echo
    printed "bench/halyard_identify_coverage --runs 20 --seconds 12 --seed 11 --off $off"
    echo
  done
}
