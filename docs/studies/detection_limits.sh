#!/bin/sh
# From which size on would a diagnosis see backlash and hysteresis, with joint encoders of several resolutions and
# noises?
#
#   docs/studies/detection_limits.sh OUT [HALYARD]
#
# runs `halyard diagnose --plan` on limits.xml for each of them, and writes OUT/limits.csv, with an empty limit where an
# effect is not seen at its largest size. HALYARD: the program (default: ./run of this project).
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../..
out=$1 halyard=${2:-$root/run}
mkdir -p "$out"
out=$(cd "$out" && pwd)
model=$root/examples/raven2/raven2.xml

echo "effect,joint,resolution_factor,noise_rad,parameter,limit,unit,naming_limit" >"$out/limits.csv.part"
for factor in 0.1 1 3 10 30 100; do
  # Joints 1 and 2 have 80000 counts a turn, joint 3 a resolution of 5 um.
  rotary=$(awk "BEGIN { print 2 * 3.14159265358979 / 80000 * $factor }")
  prismatic=$(awk "BEGIN { print 5e-6 * $factor }")
  sed -e "s/joint_counts=\"80000\"/joint_resolution=\"$rotary\"/" \
    -e "s/joint_resolution=\"5e-6\"/joint_resolution=\"$prismatic\"/" "$model" >"$out/model.xml"
  for noise in 0 1e-4 1e-3; do
    # 1 m of joint 3 counts like 16 rad: its resolution beside that of the others.
    sed -e 's#model="[^"]*"#model="model.xml"#' \
      -e "s/joint_position_noise=\"[^\"]*\"/joint_position_noise=\"$noise $noise $(awk "BEGIN { print $noise / 16 }")\"/" \
      "$here/limits.xml" >"$out/scenario.xml"
    "$halyard" diagnose --plan "$out/model.xml" "$out/scenario.xml" >"$out/printed"
    awk -F '  +' -v of="$factor,$noise" '
      $1 == "backlash" || $1 == "hysteresis" {
        seen = $3 !~ /not excited/
        sub(/not excited up to /, "", $3)
        split($3, limit, " "); split($4, naming, " ")
        printf "%s,%s,%s,%s,%s,%s,", $1, $2, of, limit[1], seen ? limit[2] : "", limit[3]
        print (naming[1] + 0 > 0 ? naming[1] : "")
      }' "$out/printed" >>"$out/limits.csv.part"
  done
done
mv "$out/limits.csv.part" "$out/limits.csv"
rm -f "$out/model.xml" "$out/scenario.xml" "$out/printed"
