#!/usr/bin/env bash
# Measures the estimator and writes results/bench/estimator.{csv,md}: counts first, which a machine with the same compiler
# repeats to the last digit, then wall times, which it does not. Needs valgrind. `benches/record.sh [REPEATS]`, 5 by default.
set -euo pipefail
cd "$(dirname "$0")/.."
export CARGO_TERM_COLOR=never LC_ALL=C.UTF-8
repeats=${1:-5}
command -v valgrind >/dev/null || { echo "valgrind is not installed" >&2; exit 2; }
out=results/bench
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

cargo bench --bench instructions >"$work/counts"
cargo bench --bench estimator --no-run
read -r load _ </proc/loadavg
for _ in $(seq "$repeats"); do
  cargo bench --quiet --bench estimator
done >"$work/times"

# The fastest of all repetitions and the median of their medians. A line of divan's tree:
# │  ├─ standing     292.6 ns      │ 301.3 ns      │ 295.2 ns      │ 295.4 ns      │ 100     │ 800
awk '
  function ns(text,  part) { split(text, part, " "); return part[1] * unit[part[2]] }
  BEGIN { unit["ns"] = 1; unit["µs"] = 1e3; unit["ms"] = 1e6; unit["s"] = 1e9 }
  /^(├|╰)─ / { list = $2 }
  /^(│|  ) +(├|╰)─ / {
    sub(/^(│|  ) +(├|╰)─ /, "")
    split($0, column, "│")
    name = list "/" $1
    sub(/^[^ ]+ +/, "", column[1])
    printf "%s %.9g %.9g\n", name, ns(column[1]), ns(column[3])
  }' "$work/times" | sort -k1,1 -k3,3g |
  awk '
  function flush() { if (name) printf "%s,%.4g,%.4g\n", name, fastest, medians[int((n + 1) / 2)] }
  $1 != name { flush(); name = $1; n = 0; fastest = $2 }
  { medians[++n] = $3; if ($2 < fastest) fastest = $2 }
  END { flush() }' >"$work/nanoseconds"
test -s "$work/nanoseconds" || { echo "the output of divan was not understood" >&2; exit 1; }

awk -F, -v OFS=, '
  NR == FNR { time[$1] = $2 OFS $3; next }
  FNR == 1 { print $0, "fastest_ns", "median_ns"; next }
  !($1 in time) { print "no time for " $1 >"/dev/stderr"; exit 1 }
  { print $0, time[$1] }' "$work/nanoseconds" "$work/counts" >"$work/estimator.csv"

# Columns of the table: case,trajectories,instructions,evaluations,paper_evaluations,fastest_ns,median_ns.
{
  cat <<'TEXT'
# The estimator in figures

Written by `benches/record.sh`; the same figures stand in estimator.csv. `zhuyi reproduce --check` does not look at them. What each
case asks is told in benches/estimator/cases.rs: `one_actor` is one trajectory, `many` is actors x trajectories of each,
`whole_run` is every actor at every 10 ms step of a 30 s run.

TEXT
  awk -F, '
    $1 == "many/2x1" {
      printf "Two actors with one trajectory each: the paper counts %d kilo-operations (|A| |T| M L = %d evaluations\n", $5 / 10, $5
      printf "of about 100) and 2 ms on its machine. Here it is %.1f kilo-instructions, %d evaluations and %.2f µs, %.0f times less.\n\n", $3 / 1e3, $4, $6 / 1e3, 2e6 / $6
    }' "$work/estimator.csv"
  echo "## Counts"
  echo
  echo "\`cargo bench --bench instructions\`, counted by $(valgrind --version), $(rustc --version | cut -d' ' -f1,2), $(rustc -vV | sed -n 's/^host: //p')."
  cat <<'TEXT'
An evaluation holds one latency against one piece of a future; the paper's are |A| |T| M L, 300 per trajectory.

| case | trajectories | instructions | per trajectory | evaluations | paper's |
|---|--:|--:|--:|--:|--:|
TEXT
  awk -F, 'NR > 1 { printf "| %s | %d | %d | %.0f | %s | %s |\n", $1, $2, $3, $3 / $2, $4 == "" ? "-" : $4, $5 == "" ? "-" : $5 }' "$work/estimator.csv"
  echo
  echo "## Wall time"
  echo
  echo "\`cargo bench --bench estimator\`, $repeats times: the fastest of all samples, and the median of the medians."
  echo "On $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(nproc) cores; load average at the start $load."
  cat <<'TEXT'

| case | fastest | median | fastest per trajectory |
|---|--:|--:|--:|
TEXT
  awk -F, '
    function time(ns) { return ns < 1e3 ? sprintf("%.0f ns", ns) : ns < 1e6 ? sprintf("%.2f µs", ns / 1e3) : sprintf("%.2f ms", ns / 1e6) }
    NR > 1 { printf "| %s | %s | %s | %s |\n", $1, time($6), time($7), time($6 / $2) }' "$work/estimator.csv"
} >"$work/estimator.md"
mv "$work/estimator.csv" "$work/estimator.md" "$out/"
echo "wrote $out/estimator.csv and $out/estimator.md"
