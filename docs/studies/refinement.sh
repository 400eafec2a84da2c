#!/bin/sh
# How many points would a sweep save that refines its grid where a curve bends?
#
#   docs/studies/refinement.sh OUT [HALYARD]
#
# runs stiffness.xml and pretension_unknown.xml with 97 values instead of 19 and 13, with 2 seeds, of kinematics and
# sr_ukf, and writes OUT/refinement.csv. Each row compares an even grid, every k-th of the values, with a grid that
# starts with 3, 4, 5, 7 or 9 values, whichever ends with the fewest, and halves the interval whose end deviated most
# from the straight line through its neighbours when it was added, until it interpolates as well as the even one. It is
# told when to stop: a real refinement does not know its error. Interpolation is linear in log x; its error is the largest deviation
# from the dense curves, over all joints. HALYARD: the program (default: ./run of this project).
set -eu
here=$(cd "$(dirname "$0")" && pwd)
out=$1 halyard=${2:-$here/../../run}
mkdir -p "$out"
out=$(cd "$out" && pwd)

echo "study,what,even_points,error,refined_points" >"$out/refinement.csv.part"
for study in stiffness pretension_unknown; do
  sed -e "s#scenario=\"#scenario=\"$here/#" -e 's/steps="[0-9]*"/steps="97"/' -e 's/repeats="[0-9]*"/repeats="2"/' \
    -e 's/estimators="[^"]*"/estimators="kinematics,sr_ukf"/' "$here/$study.xml" >"$out/$study.xml"
  "$halyard" sweep "$out/$study.xml" --out "$out/$study" >&2
  for what in gain log_error; do
    awk -F , -v study=$study -v what=$what '
      function abs(x) { return x < 0 ? -x : x }
      # Largest deviation at value i from the line through values a and b, over all curves.
      function deviation(i, a, b,    j, d, most) {
        most = 0
        for (j = 1; j <= 3; ++j) {
          d = abs(y[j, i] - y[j, a] - (x[i] - x[a]) / (x[b] - x[a]) * (y[j, b] - y[j, a]))
          if (d > most) most = d
        }
        return most
      }
      # Largest deviation of all values; has[i]: value i is in the grid.
      function error_of(has,    i, a, b, d, most) {
        most = 0; a = 1; b = 0
        for (i = 1; i <= n; ++i) {
          if (has[i]) { a = i; b = 0; continue }
          if (!b) for (b = i; !has[b]; ++b);
          d = deviation(i, a, b)
          if (d > most) most = d
        }
        return most
      }
      function clear(list,    i) { for (i in list) delete list[i] }
      # Points of the refinement from `start` values on to this error.
      function refined(start, goal,    has, score, i, a, b, d, worst, from, to, points, step) {
        step = (n - 1) / (start - 1)
        for (i = 1; i <= n; i += step) has[i] = 1
        # score: of the interval that starts at a value.
        for (i = 1 + step; i < n; i += step) {
          d = deviation(i, i - step, i + step)
          score[i] = d
          if (d > score[i - step]) score[i - step] = d
        }
        points = start
        while (error_of(has) > goal) {
          worst = -1
          for (a = 1; a < n; a = b) {
            for (b = a + 1; !has[b]; ++b);
            if (b - a < 2) continue
            if (score[a] > worst) { worst = score[a]; from = a; to = b }
          }
          i = int((from + to) / 2)
          score[from] = score[i] = deviation(i, from, to)
          has[i] = 1; ++points
        }
        clear(has); clear(score)
        return points
      }
      FNR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
      {
        if (!($2 in place)) { place[$2] = ++n; x[n] = log($2) }
        sum[$at["estimator"], $at["joint"], place[$2]] += $at["mean_absolute_error"]
      }
      END {
        for (j = 1; j <= 3; ++j)
          for (i = 1; i <= n; ++i) {
            of_filter = sum["sr_ukf", j, i]
            y[j, i] = what == "gain" ? 1 - of_filter / sum["kinematics", j, i] : log(of_filter)
          }
        split("16 12 8 6 4 3 2", every, " "); split("3 4 5 7 9", starts, " ")
        for (e = 1; e <= 7; ++e) {
          for (i = 1; i <= n; i += every[e]) even[i] = 1
          goal = error_of(even); clear(even)
          fewest = n
          for (s = 1; s <= 5; ++s) if ((points = refined(starts[s], goal)) < fewest) fewest = points
          printf "%s,%s,%d,%.4g,%d\n", study, what, (n - 1) / every[e] + 1, goal, fewest
        }
      }' "$out/$study/sweep.csv" >>"$out/refinement.csv.part"
  done
done
mv "$out/refinement.csv.part" "$out/refinement.csv"
