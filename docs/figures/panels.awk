# Panels of curves as SVG. Input, separated by tabs, one line for each value:
#
#   row  column  curve  x  y
#
# Several values of one curve at one x become their mean with its 95 % interval (Student's). A curve whose name begins
# with "*" is drawn as marks: points that others published. Panels of a row share the y axis if same_y is given.
# Variables: x_label, y_label (with unit), y_labels (of the rows, separated by "|", instead of one), linear_x, linear_y.

function log10(v) { return log(v) / log(10) }
# 97.5th percentile of Student's distribution (Abramowitz and Stegun 26.7.5), n > 4 degrees of freedom.
function student(n,   z) {
  z = 1.959964
  return z + (z ^ 3 + z) / 4 / n + (5 * z ^ 5 + 16 * z ^ 3 + 3 * z) / 96 / n ^ 2
}
function floor(v) { return v < int(v) ? int(v) - 1 : int(v) }
function scaled_x(v) { return linear_x ? v : log10(v) }
function scaled_y(v) { return linear_y ? v : log10(v) }

BEGIN {
  FS = "\t"
  split("#0072b2 #d55e00 #009e73 #cc79a7 #56b4e9 #b8860b #000000 #7d3c98", colour, " ")
  panel_width = 215; panel_height = 165; left_margin = 74; gap = 62; row_gap = 60
}
{
  if (!($1 in row_number)) { row_number[$1] = ++rows; row_name[rows] = $1 }
  if (!($2 in column_number)) { column_number[$2] = ++columns; column_name[columns] = $2 }
  if (!($3 in curve_number)) { curve_number[$3] = ++curves; curve_name[curves] = $3; lines += $3 !~ /^[*|]/ }
  if (!(($3, $4) in known)) { known[$3, $4] = 1; value[$3, ++places[$3]] = $4 }
  key = $1 SUBSEP $2 SUBSEP $3 SUBSEP $4
  ++n[key]; sum[key] += $5; squares[key] += $5 * $5
  if (extent++ == 0 || scaled_x($4) < x_from) x_from = scaled_x($4)
  if (extent == 1 || scaled_x($4) > x_to) x_to = scaled_x($4)
}

# Mean plus `side` times its half width; on a logarithmic axis never below a tenth of the mean.
function edge(key, side,   c, m, variance, e) {
  c = n[key]; m = sum[key] / c
  variance = c > 5 ? (squares[key] - c * m * m) / (c - 1) / c : 0
  e = m + side * (variance > 0 ? student(c - 1) * sqrt(variance) : 0)
  return linear_y || e > m / 10 ? e : m / 10
}

function px(x) { return sprintf("%.1f", left + (scaled_x(x) - x_from) / (x_to - x_from) * panel_width) }
function py(y) { return sprintf("%.1f", top + panel_height - (scaled_y(y) - y_from) / (y_to - y_from) * panel_height) }
function text(x, y, anchor, words, more) {
  printf "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\"%s>%s</text>\n", x, y, anchor, more, words
}
function line(x1, y1, x2, y2) {
  printf "<line x1=\"%s\" y1=\"%s\" x2=\"%s\" y2=\"%s\" stroke=\"#e3e6eb\"/>\n", x1, y1, x2, y2
}

function dashes(x, y, way, of) {
  printf "<path d=\"M %s %s %s\" stroke=\"%s\" stroke-dasharray=\"4 3\"/>\n", x, y, way, of
}
function diamond(x, y, of) {
  return sprintf("<path d=\"M %s %s m -5 0 l 5 -5 l 5 5 l -5 5 z\" fill=\"%s\"/>\n", x, y, of)
}

# Ticks of an axis into `tick`: decades with 1, 2, 5 where they are few, or even steps. Returns how many.
function ticks(from, to, is_linear, most,   d, m, count, step, rough, i) {
  delete tick; count = 0
  if (is_linear) {
    rough = (to - from) / most; step = 10 ^ floor(log10(rough))
    step *= rough / step > 5 ? 10 : rough / step > 2 ? 5 : rough / step > 1 ? 2 : 1
    for (i = -floor(-from / step - 1e-9); i * step <= to + 1e-9 * step; ++i) tick[++count] = i * step
    return count
  }
  for (d = floor(from); d <= to + 1e-9; ++d)
    for (m = 1; m <= 5; m += m == 1 ? 1 : 3) {
      if (m > 1 && (to - from > 2.2)) continue
      if (log10(m) + d < from - 1e-9 || log10(m) + d > to + 1e-9) continue
      if (m == 1 && to - from > most && d % 2) continue
      tick[++count] = m * 10 ^ d
    }
  return count
}

# The y range of a panel: of the row if its panels share it.
function find_range(r, k,   i, j, l, key, side, e) {
  y_from = 1e99; y_to = -1e99
  for (l = same_y ? 1 : k; l <= (same_y ? columns : k); ++l)
    for (i = 1; i <= curves; ++i)
      for (j = 1; j <= places[curve_name[i]]; ++j) {
        key = row_name[r] SUBSEP column_name[l] SUBSEP curve_name[i] SUBSEP value[curve_name[i], j]
        if (!(key in n) || curve_name[i] ~ /^[|]/) continue
        for (side = -1; side <= 1; side += 2) {
          e = scaled_y(edge(key, side))
          if (e < y_from) y_from = e
          if (e > y_to) y_to = e
        }
      }
  if (linear_y) { if (y_from > 0) y_from = 0 } else { y_from = floor(y_from * 4) / 4; y_to = -floor(-y_to * 4) / 4 }
  if (y_to - y_from < 1e-9) y_to = y_from + 1
}

function frame(r, k,   i, count) {
  find_range(r, k)
  count = ticks(y_from, y_to, linear_y, 6)
  for (i = 1; i <= count; ++i) {
    line(left, py(tick[i]), left + panel_width, py(tick[i]))
    text(left - 6, py(tick[i]) + 4, "end", sprintf("%g", tick[i]))
  }
  count = ticks(x_from, x_to, linear_x, 6)
  for (i = 1; i <= count; ++i) {
    line(px(tick[i]), top, px(tick[i]), top + panel_height)
    text(px(tick[i]), top + panel_height + 16, "middle", sprintf("%g", tick[i]))
  }
  printf "<rect x=\"%s\" y=\"%s\" width=\"%s\" height=\"%s\" fill=\"none\" stroke=\"#9aa3b0\"/>\n", left, top,
    panel_width, panel_height
  title = column_name[k] (rows > 1 && row_name[r] !~ /^-/ ? ": " row_name[r] : "")
  text(left, top - 7, "start", title, " font-weight=\"bold\"")
}

function curve(r, k, i,   j, name, key, x, upper, lower, points, marks) {
  name = curve_name[i]; upper = lower = points = marks = ""
  for (j = 1; j <= places[name]; ++j) {
    x = value[name, j]; key = row_name[r] SUBSEP column_name[k] SUBSEP name SUBSEP x
    if (!(key in n)) continue
    if (name ~ /^[|]/) {
      dashes(px(x), top, "v " panel_height, colour[i])
      continue
    }
    upper = upper " " px(x) "," py(edge(key, 1))
    lower = " " px(x) "," py(edge(key, -1)) lower
    points = points " " px(x) "," py(sum[key] / n[key])
    marks = marks diamond(px(x), py(sum[key] / n[key]), colour[i])
  }
  if (name ~ /^[*]/) printf "%s", marks
  if (name ~ /^[*|]/) return
  printf "<polygon fill=\"%s\" fill-opacity=\"0.18\" points=\"%s%s\"/>\n", colour[i], upper, lower
  # Later curves are thinner, so that equal ones all show.
  width_px = lines - i < 0 ? 1.4 : 1.4 + (lines - i < 4 ? lines - i : 4)
  printf "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"%.1f\" points=\"%s\"/>\n", colour[i], width_px, points
}

# Places the names of the curves, in as many lines as they need; draws them on the second call.
function legend(draws,   i, x, y, name, length_px) {
  x = left_margin; y = 20
  for (i = 1; i <= curves; ++i) {
    name = curve_name[i]
    sub(/^[*|]/, "", name)
    length_px = 48 + 6.6 * length(name)
    if (x > left_margin && x + length_px > width) { x = left_margin; y += 20 }
    if (draws) {
      if (curve_name[i] ~ /^[*]/) printf "%s", diamond(x + 11, y, colour[i])
      else if (curve_name[i] ~ /^[|]/) dashes(x, y, "h 22", colour[i])
      else printf "<rect x=\"%d\" y=\"%d\" width=\"22\" height=\"4\" fill=\"%s\"/>\n", x, y - 2, colour[i]
      text(x + 27, y + 4, "start", name)
    }
    x += length_px
  }
  return y
}

END {
  if (!extent) exit 1
  width = left_margin + columns * panel_width + (columns - 1) * gap + 16
  head = legend(0) + 38
  height = head + rows * panel_height + (rows - 1) * row_gap + 48
  printf "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" font-family=\"sans-serif\" font-size=\"12\" " \
    "fill=\"#1c2430\">\n<rect width=\"%d\" height=\"%d\" fill=\"#ffffff\"/>\n", width, height, width, height
  legend(1)
  if (!split(y_labels, label, "|")) for (r = 1; r <= rows; ++r) label[r] = y_label
  for (r = 1; r <= rows; ++r) {
    top = head + (r - 1) * (panel_height + row_gap)
    printf "<text transform=\"translate(16,%.1f) rotate(-90)\" text-anchor=\"middle\">%s</text>\n",
      top + panel_height / 2, label[r]
    for (k = 1; k <= columns; ++k) {
      left = left_margin + (k - 1) * (panel_width + gap)
      frame(r, k)
      for (i = 1; i <= curves; ++i) curve(r, k, i)
    }
  }
  text(width / 2, height - 10, "middle", x_label)
  print "</svg>"
}
