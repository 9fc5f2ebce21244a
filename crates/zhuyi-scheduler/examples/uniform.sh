#!/bin/sh
# A rate policy of one's own: the same rate for every camera. Use it as `exec:sh crates/zhuyi-scheduler/examples/uniform.sh`.
# One line of JSON comes in per decision, one goes out. Real policies read JSON with a library; awk does for two fields.
while IFS= read -r line; do
    printf '%s\n' "$line" | awk '{
        budget = $0
        sub(/.*"budget_fps":/, "", budget)
        cameras = gsub(/[{]"name":/, "")
        rate = budget / cameras
        if (rate > 30) rate = 30
        printf "{\"rates_fps\":["
        for (i = 1; i <= cameras; i++) printf "%s%.9f", (i > 1 ? "," : ""), rate
        print "]}"
    }'
done
