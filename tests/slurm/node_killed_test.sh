#!/usr/bin/env bash
# node_killed_test.sh PROGRAM EXAMPLES: a sweep on a Slurm of two nodes, one of which dies in the middle, gives the bytes
# of the same sweep on one machine. Exit code 77 (skipped) where Slurm is not installed.
set -euo pipefail
program=$1 examples=$2
source "$(dirname "${BASH_SOURCE[0]}")/cluster.sh"

missing=$(missing_cluster_programs)
if [ -n "$missing" ]; then
  echo "skipped: no $(echo $missing); install slurmctld, slurmd, slurm-client and munge"
  exit 77
fi

folder=$(mktemp -d)
trap 'stop_cluster || true; rm -rf "$folder"' EXIT
cluster=$folder/slurm
cp "$examples"/raven2/{experiment_a.xml,raven2.xml} "$folder"
cd "$folder"
cat >study.xml <<'END'
<sweep name="two nodes" scenario="experiment_a.xml" estimators="kinematics,sr_ukf" duration="24">
  <axis parameter="joint2.cable.stiffness" factor="true" from="0.5" to="2" steps="24" scale="log" applies_to="robot"/>
</sweep>
END

fail() {
  echo "failed: $*"
  cat slurm/*.log cluster/slurm/*.log 2>/dev/null | tail -n 60
  exit 1
}
# Points of a part that are done.
done_in_part() { "$program" sweep study.xml --out cluster --status | sed -nE "s/^  part $1 of 2: ([0-9]+) of .*/\1/p"; }
at_least() { [ "$(done_in_part "$1")" -ge "$2" ]; }
all_done() { "$program" sweep study.xml --out cluster --status | grep -q '24 of 24 points are done'; }

"$program" sweep study.xml --out local >local.txt
start_cluster "$cluster" || fail "Slurm does not start"
"$program" sweep study.xml --out cluster --slurm --nodes 2

if "$program" sweep study.xml --out cluster --slurm --nodes 2 2>refused.txt; then fail "submitted twice"; fi
grep -q 'Slurm job 1 still computes this sweep' refused.txt || fail "$(cat refused.txt)"

wait_until 60 at_least 2 2 || fail "part 2 does not start"
kill_node n2
kept=$(done_in_part 2)
[ "$kept" -lt 12 ] || fail "node n2 was killed too late: part 2 was done"
if "$program" merge cluster 2>refused.txt; then fail "merged without the points of n2"; fi
# Part 1 still writes, unless it has just ended.
grep -qE 'another run writes into this folder|points are in none of the folders' refused.txt ||
  fail "$(cat refused.txt)"

wait_until 100 all_done || fail "the lost part is not computed again: $(squeue --array; sinfo --Node)"
"$program" sweep study.xml --out cluster --status
"$program" merge cluster >merged.txt
for name in sweep.json sweep.csv report.html cells/all.jsonl; do
  cmp "local/$name" "cluster/$name" || fail "$name differs"
done
[ "$(ls cluster/cells)" = all.jsonl ] || fail "parts were left: $(ls cluster/cells)"
echo "n2 was killed after $kept of 12 points; the bytes are those of the local sweep"
