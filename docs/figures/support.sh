# What the figures use: commands run once, transcripts, tables, blocks in Markdown. Sourced by regenerate.

declare -A cost needs rank=([seconds]=1 [minutes]=2 [hours]=3)
figures=()

stop() {
  echo "docs/figures/regenerate: $1" >&2
  exit 1
}

# figure NAME COST [NEEDS...]: declares a figure. NEEDS are folders in the recordings' folder, or bench.
figure() {
  figures+=("$1")
  cost[$1]=$2
  needs[$1]="${*:3}"
}

is_at_hand() {
  local need
  for need in $1; do
    if [ "$need" = bench ]; then
      [ -x "$bench/halyard_blind_trials" ] || return 1
    else
      [ -d "$recordings/$need" ] || return 1
    fi
  done
}

# Commands run in a folder of their own that looks like the project's, so that they run as they are printed.
prepare_work_folder() {
  [ -x "$program" ] || stop "$program: no such program; build it with ./run --help, or say --program FILE"
  mkdir -p "$work/out" "$work/made" "$work/printed"
  work=$(realpath "$work")
  rm -f "$work/failed"
  ln -sfn "$root/examples" "$work/examples"
  ln -sfn "$root/docs" "$work/docs"
  ln -sfn "$bench" "$work/bench"  # without blanks
  [ ! -d "$recordings" ] || ln -sfn "$(realpath "$recordings")" "$work/recordings"
  printf '#!/bin/sh\nexec "%s" "$@"\n' "$program" >"$work/run"
  chmod +x "$work/run"
}

# printed COMMAND: what the command prints. It runs once; another figure that names it gets the same text.
printed() {
  local log
  log=$work/printed/$(cksum <<<"$1" | cut -d ' ' -f 1)
  if [ ! -f "$log" ]; then
    (cd "$work" && bash -c "$1" >"$log.part" 2>"$log.errors") || {
      cat "$log.errors" >&2
      touch "$work/failed"  # where this runs in a subshell, `stop` ends that alone
      stop "failed: $1"
    }
    mv "$log.part" "$log"
  fi
  cat "$log"
}

# ran COMMAND: the command, for its files.
ran() { printed "$1" >/dev/null; }

# transcript COMMAND LINES: the command and those of its lines that match; "..." stands for lines left out. Left out
# are also the time a step takes, which differs from run to run, and the absolute paths of modules.
transcript() {
  ran "$1"
  echo "\$ $1"
  printed "$1" | sed -E 's/ \([0-9.e+-]+ us a step\)//; s/, [0-9.e+-]+ us a step//; s: \(/[^)]*\)::' |
    awk -v keep="$2" '$0 ~ keep { print; left_out = 0; next } !left_out { print "..."; left_out = 1 }'
}

# refusal COMMAND: a command that has to fail, and its message.
refusal() {
  echo "\$ $1"
  if (cd "$work" && bash -c "$1" 2>&1); then stop "did not fail: $1"; fi
}

# value FILE.csv COLUMN KEY=TEXT...: the cell of a column in the first row whose columns hold these texts.
value() {
  awk -F , -v column="$2" -v keys="${*:3}" '
    /^#/ { next }
    !n { n = split($0, header); for (i in header) at[header[i]] = i; wanted = split(keys, key, " "); next }
    {
      for (i = 1; i <= wanted; ++i) { split(key[i], k, "="); if ($at[k[1]] != k[2]) next }
      print $at[column]; found = 1; exit
    }
    END { exit !found }' "$1" || stop "$1: no $2 with ${*:3}"
}

# calculate FORMAT EXPRESSION: an arithmetic expression, printed.
calculate() { awk "BEGIN { printf \"$1\", $2 }"; }

readonly per_rad=57.29577951308232

# ---- blocks in Markdown

markdown_files() {
  (cd "$root" && { git ls-files -co --exclude-standard '*.md' 2>/dev/null ||
    find . -name '*.md' -not -path './build/*' -not -path './out/*'; })
}

file_of_block() {
  (cd "$root" && markdown_files | xargs grep -lF "<!-- figure: $1 -->") || stop "no file has a block $1"
}

# block FILE NAME: the content of a block.
block() {
  awk -v begin="<!-- figure: $2 -->" '$0 == begin { on = 1; next } /^<!-- end of figure -->/ { on = 0 } on' "$1"
}

# same_but_rounding OLD NEW: words equal, numbers within a unit of the last digit of the old or within 0.1 % of it.
same_but_rounding() {
  awk '
    function unit(text,   mantissa, exponent) {
      exponent = match(text, /[eE]/) ? substr(text, RSTART + 1) : 0
      mantissa = text; sub(/[eE].*/, "", mantissa)
      return 10 ^ (exponent - (index(mantissa, ".") ? length(mantissa) - index(mantissa, ".") : 0))
    }
    function greater(x, y) { return x > y ? x : y }
    function tokens(line, list,   n, number) {
      number = "[0-9]+(\\.[0-9]+)?(e[+-]?[0-9]+)?"
      n = 0
      while (match(line, number)) {
        list[++n] = substr(line, 1, RSTART - 1); list[++n] = substr(line, RSTART, RLENGTH)
        line = substr(line, RSTART + RLENGTH)
      }
      list[++n] = line
      return n
    }
    NR == FNR { old[FNR] = $0; lines = FNR; next }
    {
      n = tokens(old[FNR], a); m = tokens($0, b); same = n == m
      for (i = 1; same && i <= n; ++i) {
        if (a[i] == b[i]) continue
        if (i % 2 || (a[i] - b[i]) ^ 2 > 1.002 * greater(unit(a[i]), 1e-3 * a[i]) ^ 2) same = 0
      }
      if (!same) { differs = 1; print "  is:  " old[FNR]; print "  now: " $0 }
    }
    END { if (FNR != lines) { print "  " lines " lines, now " FNR; differs = 1 } exit differs }' "$1" "$2"
}

place_block() {
  local file
  file=$root/$(file_of_block "$1")
  if [ $mode = check ]; then
    block "$file" "$1" >"$work/made/$1.old"
    if ! same_but_rounding "$work/made/$1.old" "$work/made/$1" >"$work/made/$1.difference"; then
      echo "$1 in ${file#"$root"/} is stale:"
      cat "$work/made/$1.difference"
      stale=1
    fi
    return
  fi
  awk -v begin="<!-- figure: $1 -->" -v made="$work/made/$1" '
    $0 == begin { print; while ((getline line <made) > 0) print line; inside = 1; next }
    /^<!-- end of figure -->/ { inside = 0 }
    !inside' "$file" >"$work/made/whole"
  cat "$work/made/whole" >"$file"
  echo "$1: ${file#"$root"/}"
}

# place_picture NAME_svg: docs/images/NAME.svg.
place_picture() {
  local file=$root/docs/images/${1%_svg}.svg
  if [ $mode = check ]; then
    if ! same_but_rounding "$file" "$work/made/$1" >/dev/null; then
      echo "${file#"$root"/} is stale"
      stale=1
    fi
    return
  fi
  cp "$work/made/$1" "$file"
  echo "$1: ${file#"$root"/}"
}

# Links to files and headings of this repository lead somewhere.
check_links() {
  local file target path anchor found=0
  local -A headings_of=()
  while IFS=$'\t' read -r file target; do
    path=${target%%#*} anchor=
    [[ $target != *#* ]] || anchor=${target#*#}
    if [ -z "$path" ]; then path=$root/$file; else path=$root/./$file; path=${path%/*}/${target%%#*}; fi
    [ ! -d "$path" ] || [ -z "$anchor" ] || path+=/README.md
    if [ -n "$anchor" ] && [ -f "$path" ] && [ -z "${headings_of[$path]+there}" ]; then
      headings_of[$path]=$'\n'$(headings "$path")$'\n'
    fi
    if [ ! -e "$path" ] || { [ -n "$anchor" ] && [[ ${headings_of[$path]} != *$'\n'"$anchor"$'\n'* ]]; }; then
      echo "$file: link to $target leads nowhere"
      found=1
    fi
  done < <(cd "$root" && markdown_files | xargs awk '{
    gsub(/`[^`]*`/, "")
    for (rest = $0; match(rest, /\]\([^)]+\)/); rest = substr(rest, RSTART + RLENGTH)) {
      target = substr(rest, RSTART + 2, RLENGTH - 3)
      if (target !~ /^https?:/) print FILENAME "\t" target
    }
  }')
  return $found
}

# The anchors that Markdown gives to a file's headings.
headings() {
  sed -nE 's/^#+ //p' "$1" | tr '[:upper:]' '[:lower:]' | sed -E 's/[^a-z0-9_ -]//g; s/ /-/g'
}

# Every figure has one place; every block has a figure, an end, a command and content. Needs no program.
check_form() {
  local name file text bad=0
  local -A files_of=()  # the files that have a block of this name
  while IFS=: read -r file name; do
    files_of[$name]+="${files_of[$name]:+ }$file"
    [ -n "${cost[$name]:-}" ] || { echo "$file: block $name has no figure_$name"; bad=1; }
  done < <(cd "$root" && markdown_files | xargs grep -oE '^<!-- figure: [a-z0-9_]+ -->' |
    sed 's/<!-- figure: //; s/ -->//')
  for name in "${figures[@]}"; do
    if [[ $name == *_svg ]]; then
      [ -s "$root/docs/images/${name%_svg}.svg" ] || { echo "$name: no picture docs/images/${name%_svg}.svg"; bad=1; }
      continue
    fi
    file=${files_of[$name]:-}
    if [ -z "$file" ] || [[ $file == *' '* ]]; then
      echo "$name: expected in one file, is in: ${file:-none}"
      bad=1
      continue
    fi
    text=$(block "$root/$file" "$name")
    grep -qE '(\./run|halyard|halyard_[a-z_]+) ' <<<"$text" || { echo "$file: figure $name names no command"; bad=1; }
    [ "$(wc -l <<<"$text")" -ge 3 ] || { echo "$file: figure $name has no content"; bad=1; }
  done
  while read -r file; do
    awk -v file="$file" '
      /^<!-- figure: / { if (open) bad = 1; open = 1 }
      /^<!-- end of figure -->/ { if (!open) bad = 1; open = 0 }
      END { if (open || bad) { print file ": begin and end of a figure do not alternate"; exit 1 } }' "$root/$file" ||
      bad=1
  done < <(markdown_files)
  check_links || bad=1
  return $bad
}
