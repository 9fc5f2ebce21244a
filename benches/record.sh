#!/usr/bin/env bash
# Measures the estimator and the simulator and writes results/bench/{estimator,drive}.{csv,md}: counts first, which a
# machine with the same compiler repeats to the last digit, then wall times, which it does not. Needs valgrind.
# `benches/record.sh [REPEATS]`, 5 by default.
set -euo pipefail
cd "$(dirname "$0")/.."
export CARGO_TERM_COLOR=never LC_ALL=C.UTF-8
repeats=${1:-5}
command -v valgrind >/dev/null || { echo "valgrind is not installed" >&2; exit 2; }
out=results/bench
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

# measure NAME COUNTS TIMES: the counts of one bench with the times of another beside them, into NAME.csv.
measure() {
  cargo bench --bench "$2" >"$work/counts"
  cargo bench --bench "$3" --no-run
  read -r load _ </proc/loadavg
  for _ in $(seq "$repeats"); do
    cargo bench --quiet --bench "$3"
  done >"$work/times"
  bash benches/nanoseconds.sh <"$work/times" >"$work/nanoseconds"
  awk -F, -v OFS=, '
    NR == FNR { time[$1] = $2 OFS $3; next }
    FNR == 1 { print $0, "fastest_ns", "median_ns"; next }
    !($1 in time) { print "no time for " $1 >"/dev/stderr"; exit 1 }
    { print $0, time[$1] }' "$work/nanoseconds" "$work/counts" >"$work/$1.csv"
}

counted_by() {
  echo "\`cargo bench --bench $1\`, counted by $(valgrind --version), $(rustc --version | cut -d' ' -f1,2), $(rustc -vV | sed -n 's/^host: //p')."
}

timed_by() {
  echo "\`cargo bench --bench $1\`, $repeats times: the fastest of all samples, and the median of the medians."
  echo "On $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(nproc) cores; load average at the start $load."
}

# As it reads best: function of awk.
time='function time(ns) { return ns < 1e3 ? sprintf("%.0f ns", ns) : ns < 1e6 ? sprintf("%.2f µs", ns / 1e3) : sprintf("%.2f ms", ns / 1e6) }'

measure estimator instructions estimator
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
  counted_by instructions
  cat <<'TEXT'
An evaluation holds one latency against one piece of a future; the paper's are |A| |T| M L, 300 per trajectory.

| case | trajectories | instructions | per trajectory | evaluations | paper's |
|---|--:|--:|--:|--:|--:|
TEXT
  awk -F, 'NR > 1 { printf "| %s | %d | %d | %.0f | %s | %s |\n", $1, $2, $3, $3 / $2, $4 == "" ? "-" : $4, $5 == "" ? "-" : $5 }' "$work/estimator.csv"
  echo
  echo "## Wall time"
  echo
  timed_by estimator
  cat <<'TEXT'

| case | fastest | median | fastest per trajectory |
|---|--:|--:|--:|
TEXT
  awk -F, "$time"'
    NR > 1 { printf "| %s | %s | %s | %s |\n", $1, time($6), time($7), time($6 / $2) }' "$work/estimator.csv"
} >"$work/estimator.md"

measure drive drive_instructions drive
# Columns of the table: case,steps,instructions,fastest_ns,median_ns.
{
  cat <<'TEXT'
# The simulator in figures

Written by `benches/record.sh`; the same figures stand in drive.csv. `zhuyi reproduce --check` does not look at them. What each
case does is told in benches/drive/cases.rs: the first five drive benches/drive/cut-in-of-four.ron, the ego and four vehicles
for 20 s with five cameras at 30 FPR; `sweep` makes eight such runs, estimate and table included, on one thread; the last
three are scenarios of the paper's, 30 s each, with their estimate.

TEXT
  awk -F, "$time"'
    $1 == "drive/run_and_estimate" {
      printf "A run with the offline estimate of every actor at every step: %.1f million instructions and %s, %.0f times faster\n", $3 / 1e6, time($4), 20e9 / $4
      printf "than the road. A step of 10 ms takes %.1f thousand instructions.\n\n", $3 / $2 / 1e3
    }' "$work/drive.csv"
  echo "## Counts"
  echo
  counted_by drive_instructions
  cat <<'TEXT'

| case | steps | instructions | per step |
|---|--:|--:|--:|
TEXT
  awk -F, 'NR > 1 { printf "| %s | %d | %d | %.0f |\n", $1, $2, $3, $3 / $2 }' "$work/drive.csv"
  echo
  echo "## Wall time"
  echo
  timed_by drive
  cat <<'TEXT'

| case | fastest | median | fastest per step |
|---|--:|--:|--:|
TEXT
  awk -F, "$time"'
    NR > 1 { printf "| %s | %s | %s | %s |\n", $1, time($4), time($5), time($4 / $2) }' "$work/drive.csv"
} >"$work/drive.md"

for name in estimator drive; do
  mv "$work/$name.csv" "$work/$name.md" "$out/"
  echo "wrote $out/$name.csv and $out/$name.md"
done
