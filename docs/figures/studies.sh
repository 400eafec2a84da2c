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

figure blind_trials hours bench
figure_blind_trials() {
  local kind sensors shard
  # Parts of twelve, each of which spreads over the library's effects.
  while read -r kind sensors shard; do
    ran "bench/halyard_blind_trials --kind $kind --sensors $sensors --off 1 --arms raven2 --trials 60 \
--shard $shard/12 --seed 20271210 --resume --out out/trials"
  done <<'DRAWS'
clean good 1
clean poor 5
effect good 1
effect poor 5
effect motors 9
two_at_joint good 5
two_at_joint poor 9
three good 9
three poor 1
form good 1
form poor 5
outside good 9
outside poor 1
DRAWS
  ran "bench/halyard_blind_trials --summary out/trials"
  cat <<'TABLE'
From `halyard_blind_trials --seed 20271210 --arms raven2 --off 1 --kind KIND --sensors SENSORS --trials 60 --shard i/12`,
i is 1, 5 or 9: another one for each kind of sensors:

TABLE
  awk '/^## /{ inside = $2 == "Acceptance" } inside && /^[|]/' "$work/out/trials/summary.md"
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
