"""The scenario of ../drive/cut-in-of-four.ron as the other simulators see it, and the check that it truly happened.

A drive is a list with one entry per step: the time [s] and, by name, each vehicle's place along the road [m], its offset
from the middle lane [m], positive to the left, and its speed [m/s]; places are those of the vehicles' centres. zhuyi's
own drive is read from the trace that `zhuyi run --trace` writes, and its first entry gives the others their starts.
"""

import csv
import sys
import time

DURATION = 20.0
CUT_IN = 4.0
CUT_IN_TAKES = 3.0
LANE_WIDTH = 3.5
# What zhuyi's actors are long; its ego is 0.2 m longer, which the other simulators are not told.
LENGTH = 4.6
WIDTH = 1.85
STEPS = [0.1, 0.01]
REPEATS = 5


def lane(offset):
    """-1 for the right lane, 0 for the middle one, 1 for the left one."""
    return round(offset / LANE_WIDTH)


def recorded(path):
    drive = []
    for row in csv.DictReader(open(path)):
        now = float(row["time_s"])
        if not drive or drive[-1][0] != now:
            drive.append((now, {}))
        drive[-1][1][row["id"]] = tuple(float(row[key]) for key in ("s_m", "d_m", "speed_mps"))
    return drive


def check(drive, step):
    """Ends the program where the drive is not that of the scenario."""

    def must(holds, what):
        if not holds:
            sys.exit(f"{sys.argv[0]}, steps of {step} s: {what}")

    must(abs(drive[-1][0] - DURATION) < 1.5 * step, f"it ends at {drive[-1][0]} s")
    names = set(drive[0][1])
    before = None
    for now, vehicles in drive:
        must(set(vehicles) == names, f"a vehicle is missing at {now} s")
        for name, (s, d, speed) in vehicles.items():
            if before:
                moved, swerved = s - before[name][0], abs(d - before[name][1])
                must(-0.01 < moved < 30 * step, f"{name} jumps along by {moved} m at {now} s")
                must(swerved < 6 * step, f"{name} jumps across by {swerved} m at {now} s")
            for other, (other_s, other_d, _) in vehicles.items():
                apart = abs(other_s - s) > LENGTH or abs(other_d - d) > WIDTH
                must(apart or other == name, f"{name} and {other} collide at {now} s")
        cutter, ego, lead = vehicles["cutter"], vehicles["ego"], vehicles["lead"]
        must(lane(ego[1]) == lane(lead[1]) == 0, f"the ego or its lead leaves its lane at {now} s")
        if now < CUT_IN:
            must(lane(cutter[1]) == -1, f"the cutter is not on the right at {now} s")
        if now > CUT_IN + 1.5 * CUT_IN_TAKES:
            must(lane(cutter[1]) == 0, f"the cutter has not cut in at {now} s")
            must(ego[0] < cutter[0] < lead[0], f"the cutter is not before the ego at {now} s")
        before = vehicles
    ego, cutter = vehicles["ego"], vehicles["cutter"]
    must(abs(ego[2] - cutter[2]) < 1.5, f"the ego drives at {ego[2]} m/s behind the cutter's {cutter[2]} m/s")


def measure(simulator, begin):
    """Times drives of each step length: `begin(starts, step)` gets one ready and returns what makes it and what ends it.
    The first is not told, for what happens once."""
    starts = recorded(sys.argv[1])[0][1]
    for step in STEPS:
        for number in range(1 + REPEATS):
            drive, end = begin(starts, step)
            begun = time.perf_counter()
            driven = drive()
            took = time.perf_counter() - begun
            end()
            check(driven, step)
            if number > 0:
                s, _, speed = driven[-1][1]["ego"]
                print(f"{simulator},{step},{took * 1e3:.3f},{s:.1f},{speed:.1f}")


if __name__ == "__main__":
    # The check of zhuyi's own drive; its time is measured by `cargo bench`.
    driven = recorded(sys.argv[1])
    check(driven, 0.01)
    s, _, speed = driven[-1][1]["ego"]
    print(f"{s:.1f},{speed:.1f}")
