#!/usr/bin/env bash
# From the output of one or more runs of a divan bench to `LIST/CASE,FASTEST,MEDIAN` in nanoseconds: the fastest of all
# samples, and the median of the medians. A line of divan's tree:
# │  ├─ standing     292.6 ns      │ 301.3 ns      │ 295.2 ns      │ 295.4 ns      │ 100     │ 800
set -euo pipefail
export LC_ALL=C.UTF-8

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
  }' | sort -k1,1 -k3,3g |
  awk '
  function flush() { if (name) printf "%s,%.4g,%.4g\n", name, fastest, medians[int((n + 1) / 2)] }
  $1 != name { flush(); name = $1; n = 0; fastest = $2 }
  { medians[++n] = $3; if ($2 < fastest) fastest = $2 }
  END { flush(); if (!name) { print "the output of divan was not understood" >"/dev/stderr"; exit 1 } }'
