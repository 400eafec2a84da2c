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
  local kind sensors trials shards shard
  # Parts of twelve, each of which spreads over the library's effects.
  while read -r kind sensors trials shards; do
    for shard in $shards; do
      ran "$bench/halyard_blind_trials --kind $kind --sensors $sensors --off 1 --arms raven2 --trials $trials \
--shard $shard/12 --seed 20271209 --resume --out out/trials"
    done
  done <<'DRAWS'
clean good 60 5 6 7 8 9 10 11
clean poor 60 5 6 7 8 9 10 11
effect good 48 5 6 7
effect poor 48 5 6 7
effect motors 48 5 6 7
two_at_joint good 24 5 6 7
two_at_joint poor 24 5 6 7
three good 24 5 6 7
three poor 24 5 6 7
form good 60 5 6 7
form poor 60 5 6 7
outside good 60 5 6 7
outside poor 60 5 6 7
DRAWS
  ran "$bench/halyard_blind_trials --summary out/trials"
  cat <<'TABLE'
From `halyard_blind_trials --seed 20271209 --arms raven2 --off 1 --kind KIND --sensors SENSORS --trials N --shard i/12`,
i from 5 to 7, of clean arms to 11. N is 48 for one effect, 24 for two or three effects, and 60 for the other kinds:

TABLE
  awk '/^## /{ inside = $2 == "Acceptance" } inside && /^[|]/' "$work/out/trials/summary.md"
}

figure coverage hours bench
figure_coverage() {
  echo 'From `halyard_identify_coverage --runs 50 --seconds 12 --seed 11`, where all other parameters are exact:'
  echo
  ran "$bench/halyard_identify_coverage --runs 50 --seconds 12 --seed 11"
  printed "$bench/halyard_identify_coverage --runs 50 --seconds 12 --seed 11"
}

figure coverage_off hours bench
figure_coverage_off() {
  local off
  for off in stiffness everything; do
    echo "From \`halyard_identify_coverage --runs 20 --seconds 12 --seed 11 --off $off\`:"
    echo
    printed "$bench/halyard_identify_coverage --runs 20 --seconds 12 --seed 11 --off $off"
    echo
  done
}
