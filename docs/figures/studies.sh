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

trial_row() {  # TEXT QUESTION: of summary.md, count and interval
  awk -F ' [|] ' -v text="$1" -v question="| $2" '
    $1 == question { sub(/ \|$/, "", $5); print "| " text " | " $3 " | " $5 " |" }' "$work/out/trials/summary.md"
}

figure blind_trials hours bench
figure_blind_trials() {
  local trials="$bench/halyard_blind_trials --seed 2028 --out out/trials"
  ran "$trials --kind clean_exact --kind clean_mistuned --trials 150"
  ran "$trials --kind each_effect --trials 46"
  ran "$trials --kind pair --trials 14"
  ran "$trials --kind outside --trials 10"
  ran "$bench/halyard_blind_trials --summary out/trials"
  cat <<'TABLE'
From `halyard_blind_trials --seed 2028` with `--kind clean_exact --kind clean_mistuned --trials 150`,
`--kind each_effect --trials 46`, `--kind pair --trials 14` and `--kind outside --trials 10`:

| | count | 95 % interval |
|---|---:|---:|
TABLE
  trial_row 'clean arms with an effect named, exact numbers' 'clean_exact: an effect is named'
  trial_row 'clean arms with an effect named, every number off within its tolerance' \
    'clean_mistuned: an effect is named'
  trial_row 'every effect in turn: effect and joint right and first' 'each_effect: effect and joint right, first'
  trial_row 'outside the library: `unknown`, or an unexplained residual' \
    'outside: unknown, or named with an unexplained residual'
  trial_row 'pairs, both named' 'pair: both named'
  trial_row 'true numbers within their 95 % interval, every effect in turn' \
    'a true parameter lies in its 95 % interval (each_effect)'
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
