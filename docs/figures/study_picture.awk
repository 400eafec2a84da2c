# A study over one axis as SVG: a panel for each joint, mean absolute error over the axis' value, both logarithmic, a
# curve for each estimator with the 95 % interval of its mean over the seeds. Input: sweep.csv. Variables: axis (label).

function log10(v) { return log(v) / log(10) }
# 97.5th percentile of Student's distribution (Abramowitz and Stegun 26.7.5), n > 4 degrees of freedom.
function student(n,   z) { z = 1.959964; return z + (z ^ 3 + z) / 4 / n + (5 * z ^ 5 + 16 * z ^ 3 + 3 * z) / 96 / n ^ 2 }

BEGIN { FS = ","; split("#0072b2 #d55e00 #009e73 #cc79a7", colour, " ") }
FNR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
$at["mean_absolute_error"] != "" {
  x = $2; e = $at["estimator"]; k = $at["joint"]
  shown = $at["unit"] == "m" ? 1000 : 180 / 3.14159265358979
  unit[k] = $at["unit"] == "m" ? "mm" : "deg"
  v = $at["mean_absolute_error"] * shown
  if (!(x in place)) { place[x] = ++places; value[places] = x }
  if (!(e in number)) { number[e] = ++estimators; name[estimators] = e }
  if (k > joints) joints = k
  ++n[x, e, k]; sum[x, e, k] += v; squares[x, e, k] += v * v
}

function px(x) { return sprintf("%.1f", left + (log10(x) - x_from) / (x_to - x_from) * 200) }
function py(y) { return sprintf("%.1f", 250 - (log10(y) - y_from) / (y_to - y_from) * 190) }
function floor(v) { return v < int(v) ? int(v) - 1 : int(v) }

# Mean plus `side` times its half width; never below a tenth of the mean, for the logarithm.
function edge(x, e, k, side,   c, m, variance) {
  c = n[x, e, k]; m = sum[x, e, k] / c
  variance = c > 5 ? (squares[x, e, k] - c * m * m) / (c - 1) / c : 0
  m += side * (variance > 0 ? student(c - 1) * sqrt(variance) : 0)
  return m > sum[x, e, k] / c / 10 ? m : sum[x, e, k] / c / 10
}

function panel(k,   i, e, x, d, upper, lower, line) {
  left = 70 + (k - 1) * 275
  y_from = 99; y_to = -99
  for (i = 1; i <= places; ++i)
    for (e in number) {
      if (log10(edge(value[i], e, k, -1)) < y_from) y_from = log10(edge(value[i], e, k, -1))
      if (log10(edge(value[i], e, k, 1)) > y_to) y_to = log10(edge(value[i], e, k, 1))
    }
  y_from = floor(y_from); y_to = -floor(-y_to)
  for (d = y_from; d <= y_to; ++d) {
    printf "<line x1=\"%d\" x2=\"%d\" y1=\"%s\" y2=\"%s\" stroke=\"#e6e9ee\"/>\n", left, left + 200, py(10 ^ d), py(10 ^ d)
    printf "<text x=\"%d\" y=\"%.1f\" text-anchor=\"end\">%g</text>\n", left - 6, py(10 ^ d) + 4, 10 ^ d
  }
  for (d = -floor(-x_from); d <= floor(x_to); ++d) {
    printf "<line x1=\"%s\" x2=\"%s\" y1=\"60\" y2=\"250\" stroke=\"#e6e9ee\"/>\n", px(10 ^ d), px(10 ^ d)
    printf "<text x=\"%s\" y=\"268\" text-anchor=\"middle\">%g</text>\n", px(10 ^ d), 10 ^ d
  }
  printf "<text x=\"%d\" y=\"52\" font-weight=\"bold\">Joint %d [%s]</text>\n", left, k, unit[k]
  for (i = 1; i <= estimators; ++i) {
    e = name[i]; upper = lower = line = ""
    for (j = 1; j <= places; ++j) {
      x = value[j]
      upper = upper " " px(x) "," py(edge(x, e, k, 1))
      lower = " " px(x) "," py(edge(x, e, k, -1)) lower
      line = line " " px(x) "," py(sum[x, e, k] / n[x, e, k])
    }
    printf "<polygon fill=\"%s\" fill-opacity=\"0.2\" points=\"%s%s\"/>\n", colour[i], upper, lower
    # Later curves are thinner, so that equal ones all show.
    printf "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"%.1f\" points=\"%s\"/>\n", colour[i],
      1.4 + 0.8 * (estimators - i), line
  }
}

END {
  x_from = log10(value[1]); x_to = log10(value[places])
  width = 20 + joints * 275
  printf "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d 310\" font-family=\"sans-serif\" font-size=\"12\" " \
    "fill=\"#1c2430\">\n<rect width=\"%d\" height=\"310\" fill=\"#ffffff\"/>\n", width, width
  for (i = 1; i <= estimators; ++i) {
    printf "<rect x=\"%d\" y=\"18\" width=\"22\" height=\"4\" fill=\"%s\"/>\n", 70 + (i - 1) * 120, colour[i]
    printf "<text x=\"%d\" y=\"24\">%s</text>\n", 98 + (i - 1) * 120, name[i]
  }
  for (k = 1; k <= joints; ++k) panel(k)
  printf "<text x=\"%d\" y=\"296\" text-anchor=\"middle\">%s</text>\n</svg>\n", width / 2, axis
}
