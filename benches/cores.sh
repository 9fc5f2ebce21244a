#!/usr/bin/env bash
# A sweep on one thread and on two: the instructions of the whole process, all threads together, and the runs per second.
# Writes results/bench/cores.{csv,md}. `benches/cores.sh [ROUNDS]`, 5 by default; needs valgrind and two cores that have
# nothing else to do: the first line tells the load.
set -euo pipefail
cd "$(dirname "$0")/.."
export CARGO_TERM_COLOR=never LC_ALL=C.UTF-8
rounds=${1:-5}
command -v valgrind >/dev/null || { echo "valgrind is not installed" >&2; exit 2; }
out=results/bench
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"
counted=20 timed=400

cargo build --release
# sweep JOBS RUNS [TOOL ..]: drives with their estimate into a table, as always.
sweep() {
  local jobs=$1 runs=$2
  shift 2
  rm -rf "$work/sweep"
  "$@" target/release/zhuyi sweep benches/drive/cut-in-of-four.ron --fpr 30 --seeds "$runs" --jobs "$jobs" \
    --out "$work/sweep" >"$work/told" 2>"$work/progress"
}
for jobs in 1 2; do
  sweep "$jobs" "$counted" valgrind --tool=callgrind --quiet --callgrind-out-file="$work/calls.$jobs"
done
read -r load _ </proc/loadavg
echo "load average $load" >&2
for _ in $(seq "$rounds"); do
  for jobs in 1 2; do
    begun=$EPOCHREALTIME
    sweep "$jobs" "$timed"
    awk -v jobs="$jobs" -v took="$begun $EPOCHREALTIME" 'BEGIN { split(took, at, " "); print jobs, at[2] - at[1] }'
  done
done | sort -k1,1n -k2,2g >"$work/times"

{
  echo "threads,instructions_per_run,fastest_runs_per_s,median_runs_per_s"
  for jobs in 1 2; do
    instructions=$(sed -n 's/^totals: *//p' "$work/calls.$jobs")
    awk -v OFS=, -v jobs="$jobs" -v instructions="$instructions" -v counted="$counted" -v timed="$timed" '
      $1 == jobs { times[++n] = $2 }
      END { printf "%d,%.0f,%.1f,%.1f\n", jobs, instructions / counted, timed / times[1], timed / times[int((n + 1) / 2)] }' "$work/times"
  done
} >"$work/cores.csv"
{
  cat <<'TEXT'
# One core and two

Written by `benches/cores.sh`; the same figures stand in cores.csv. A sweep of benches/drive/cut-in-of-four.ron with estimate
(`zhuyi sweep --jobs 1` and `--jobs 2`), start of the process and table included.

TEXT
  echo "Instructions of all threads: $counted runs under $(valgrind --version), which runs one thread at a time. Speed: $timed runs, $rounds rounds,"
  echo "on $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(nproc) cores; load average at the start $load."
  cat <<'TEXT'

| threads | instructions per run | fastest | median |
|--:|--:|--:|--:|
TEXT
  awk -F, 'NR > 1 { printf "| %d | %.2f million | %.1f runs/s | %.1f runs/s |\n", $1, $2 / 1e6, $3, $4 }' "$work/cores.csv"
  echo
  awk -F, '
    NR > 1 { instructions[$1] = $2; fastest[$1] = $3 }
    END { printf "Two threads do %.2f %% more instructions and %.2f times the runs.\n", 100 * (instructions[2] / instructions[1] - 1), fastest[2] / fastest[1] }' "$work/cores.csv"
} >"$work/cores.md"
mv "$work/cores.csv" "$work/cores.md" "$out/"
echo "wrote $out/cores.csv and $out/cores.md"
