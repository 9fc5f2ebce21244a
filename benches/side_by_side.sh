#!/usr/bin/env bash
# Drives one scenario in zhuyi, highway-env and SUMO, in turn, and writes results/bench/side_by_side.{csv,md}: wall times of
# this machine, and what each simulator does for them. `benches/side_by_side.sh [ROUNDS]`, 5 by default; a few minutes.
# Needs Python 3.9 or newer with venv, and installs the other two simulators below target/.
set -euo pipefail
cd "$(dirname "$0")/.."
export CARGO_TERM_COLOR=never LC_ALL=C.UTF-8 PYTHONDONTWRITEBYTECODE=1
rounds=${1:-5}
out=results/bench
here=benches/side_by_side
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

venv=target/side_by_side
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check -r "$here/requirements.txt"
cargo build --release
cargo bench --bench drive --no-run

# The same start for all, without the jitter between seeds.
target/release/zhuyi run benches/drive/cut-in-of-four.ron --set jitter.position_m=0 --set jitter.speed_mps=0 \
  --trace "$work/trace.csv" >"$work/run.txt"
read -r load _ </proc/loadavg
for round in $(seq "$rounds"); do
  echo "round $round of $rounds" >&2
  "$venv/bin/python" "$here/in_highway_env.py" "$work/trace.csv" >>"$work/others"
  "$venv/bin/python" "$here/in_sumo.py" "$work/trace.csv" >>"$work/others"
  cargo bench --quiet --bench drive -- run --sample-count 5 >>"$work/divan"
done

# SIMULATOR,STEP,FASTEST_MS,MEDIAN_MS,EGO_S,EGO_SPEED
end=$("$venv/bin/python" "$here/scenario.py" "$work/trace.csv")
bash benches/nanoseconds.sh <"$work/divan" | awk -F, -v OFS=, -v end="$end" '
  BEGIN { name["drive/run"] = "zhuyi"; name["drive/run_and_estimate"] = "zhuyi with the estimate" }
  $1 in name { print name[$1], 0.01, $2 / 1e6, $3 / 1e6, end }' >"$work/rows"
sort -t, -k1,1 -k2,2gr -k3,3g "$work/others" | awk -F, -v OFS=, '
  function flush() { if (n) print key, times[1], times[int((n + 1) / 2)], end }
  key != $1 OFS $2 { flush(); key = $1 OFS $2; n = 0 }
  { times[++n] = $3; end = $4 OFS $5 }
  END { flush() }' >>"$work/rows"
{ echo "simulator,step_s,fastest_ms,median_ms,ego_s_m,ego_speed_mps"; cat "$work/rows"; } >"$work/side_by_side.csv"

version() { "$venv/bin/python" -c "from importlib.metadata import version; print(version('$1'))"; }
{
  cat <<'TEXT'
# Side by side with other simulators

Written by `benches/side_by_side.sh`; the same figures stand in side_by_side.csv. One scenario, benches/drive/cut-in-of-four.ron: a
straight road of 3 lanes, the ego and four vehicles, of which a slower one cuts in before the ego at 4 s; 20 s. All start from the
same places at the same speeds. That the drive was truly that one is checked each time: five vehicles at every step, none of which
jumps or touches another; the cutter on the right until 4 s and before the ego 4.5 s later; the ego behind it at its speed at the end.

TEXT
  echo "zhuyi $(target/release/zhuyi --version | cut -d' ' -f2), $(rustc --version | cut -d' ' -f1,2); highway-env $(version highway-env) and SUMO $(version libsumo) by libsumo, $("$venv/bin/python" --version)."
  echo "On one core of $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(nproc) cores; load average at the start $load. $rounds rounds of five drives each, the simulators in turn."
  cat <<'TEXT'

| simulator | step | fastest | median | as fast as the road, times | where the ego is at 20 s | its speed then |
|---|--:|--:|--:|--:|--:|--:|
TEXT
  awk -F, 'NR > 1 { printf "| %s | %s s | %.2f ms | %.2f ms | %.0f | %.0f m | %.1f m/s |\n", $1, $2, $3, $4, 20e3 / $3, $5, $6 }' "$work/side_by_side.csv"
  cat <<'TEXT'

Timed is the drive of 20 s with all places and speeds read out or recorded after every step; not timed is the start of a process and
the reading of files. zhuyi has one step, 10 ms; its timed drive is that of seed 0, whose starts are up to 0.5 m and 0.2 m/s elsewhere.

What each does for its time, at every step unless told otherwise:

| | zhuyi | highway-env | SUMO |
|---|---|---|---|
| ego | kinematic bicycle with lags of engine, brakes and steering, limits of jerk and friction | kinematic bicycle, commands take effect at once | a place along the lane and a speed; it steers nowhere |
| ego's driver | improved IDM, hard braking and evasion, on what its cameras have confirmed | IDM on the truth; MOBIL is off | IDM on the truth; lane changes of its own are off |
| other vehicles | scripted; the follower by IDM | all by IDM and steering, scripted lane change | all by IDM, scripted lane change |
| contact | boxes of the ego and each other, swept over the step, then the crash | boxes at the end of the step, every pair | gaps along a lane |
| cameras | five at 30 frames/s with their phases; what is seen in a frame past what hides it; noise | none | none |
| tracking | confirmation over five frames, filtered tracks, prediction | none | none |
| estimate of the rates needed | second row: every actor at every step, for each camera | none | none |
| randomness, record | seeded by names; all states kept | none here; read out by its Python objects | none here; read out by libsumo's calls |

What the others do and zhuyi does not: highway-env is made for learning, with observations, rewards, pictures, lane changes by MOBIL,
junctions and roundabouts, none of which is used here, and is written in Python; SUMO carries whole cities with networks, routes,
signals and demand, its cost per vehicle falls with their number, and its step is meant to be long: 1 s by default.
TEXT
} >"$work/side_by_side.md"
mv "$work/side_by_side.csv" "$work/side_by_side.md" "$out/"
echo "wrote $out/side_by_side.csv and $out/side_by_side.md"
