# docs/identification.md.

figure tension minutes
figure_tension() {
  local kind scenario=examples/raven2/identification command out coupling k
  local -A commands
  local identify='./run identify --model examples/raven2/raven2_exponential.xml --data out'
  echo '```'
  for kind in high low; do
    command="./run simulate ${scenario}_${kind}_tension.xml --out out/$kind.csv"
    echo "\$ $command"
    ran "$command"
  done
  commands[high]="$identify/high.csv --parameters coupling --out out/high"
  commands[low]="$identify/low.csv --parameters coupling --out out/low"
  commands[both]="$identify/low.csv --parameters coupling,tension --out out/low_tension"
  for out in high low both; do
    transcript "${commands[$out]}" 'coupling|tension|joint 2 sr_ukf'
  done
  echo '```'
}
