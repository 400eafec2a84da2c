# The picture on the README's first screen, as SVG. Input: the log, then the estimates of kinematics, of sr_ukf with the
# given model, and of sr_ukf with the revised model. Drawn: estimate minus joint sensor at joint 2, in deg, over the last
# third of the log: the least and the largest of every 20 ms, so that no peak is left out.

FNR == 1 { ++file }
/^#/ { next }
!($1 ~ /^[0-9.]/) { for (i = 1; i <= NF; ++i) if ($i == "joint_position_2") column[file] = i; next }
file == 1 { sensor[$1] = $column[1]; end = $1; next }
{
  if ($1 < 2 * end / 3) next
  error = ($column[file] - sensor[$1]) * per_rad
  bin = int($1 * 50 + 1e-6)
  if (!((file, bin) in least) || error < least[file, bin]) { least[file, bin] = error; least_at[file, bin] = $1 }
  if (!((file, bin) in largest) || error > largest[file, bin]) { largest[file, bin] = error; largest_at[file, bin] = $1 }
}

function x(t) { return sprintf("%.1f", 70 + (t - first) / (end - first) * 640) }
function y(e) { return sprintf("%.1f", 175 - e / 0.45 * 120) }
function line(name, which, colour, at,   i, path, low, high) {
  for (i = int(first * 50); i <= end * 50; ++i)
    if ((which, i) in least) {
      low = x(least_at[which, i]) "," y(least[which, i])
      high = x(largest_at[which, i]) "," y(largest[which, i])
      path = path (path == "" ? "" : " ") (least_at[which, i] < largest_at[which, i] ? low " " high : high " " low)
    }
  printf "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"1.8\" points=\"%s\"/>\n", colour, path
  printf "<rect x=\"%d\" y=\"42\" width=\"22\" height=\"4\" fill=\"%s\"/>\n", at, colour
  printf "<text x=\"%d\" y=\"49\">%s</text>\n", at + 28, name
}

END {
  first = 2 * end / 3
  print "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 760 330\" font-family=\"sans-serif\" font-size=\"14\"",
    "fill=\"#1c2430\">"
  print "<rect width=\"760\" height=\"330\" fill=\"#ffffff\"/>"
  print "<text x=\"70\" y=\"24\" font-size=\"16\" font-weight=\"bold\">" \
    "Error of the estimated position of joint 2, in deg</text>"
  for (e = -0.4; e < 0.41; e += 0.2) {
    printf "<line x1=\"70\" x2=\"710\" y1=\"%s\" y2=\"%s\" stroke=\"%s\"/>\n", y(e), y(e),
      e * e < 1e-9 ? "#9aa4b2" : "#e6e9ee"
    printf "<text x=\"62\" y=\"%.1f\" text-anchor=\"end\">%.1f</text>\n", y(e) + 5, e * e < 1e-9 ? 0 : e
  }
  for (t = first; t < end + 0.01; ++t) printf "<text x=\"%s\" y=\"310\" text-anchor=\"middle\">%.0f s</text>\n", x(t), t
  line("kinematics (rigid cables)", 2, "#0072b2", 70)
  line("sr_ukf, given model", 3, "#d55e00", 290)
  line("sr_ukf, revised model", 4, "#009e73", 470)
  print "</svg>"
}
