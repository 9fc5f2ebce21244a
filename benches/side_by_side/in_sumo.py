"""The scenario in SUMO through libsumo: `python in_sumo.py TRACE` prints a line per step length (see scenario.py).

All five vehicles follow by IDM with SUMO's own parameters, and none changes lanes but the cutter, on command and over 3 s.
Reading the network and putting the vehicles on it are not timed; reading all places and speeds after each step is.
"""

import os
import tempfile

import libsumo

from scenario import CUT_IN, CUT_IN_TAKES, DURATION, LANE_WIDTH, LENGTH, WIDTH, lane, measure

NETWORK = """<net version="1.20">
  <location netOffset="0,0" convBoundary="0,0,2000,10" origBoundary="0,0,2000,10" projParameter="!"/>
  <edge id="road" from="a" to="b" priority="1">
    {lanes}
  </edge>
  <junction id="a" type="dead_end" x="0" y="0" incLanes="" intLanes="" shape="0,5 0,-5"/>
  <junction id="b" type="dead_end" x="2000" y="0" incLanes="road_0 road_1 road_2" intLanes="" shape="2000,-5 2000,5"/>
</net>"""
LANE = '<lane id="road_{0}" index="{0}" speed="40" length="2000" width="{2}" shape="0,{1} 2000,{1}"/>'


TYPE = f"""<additional>
  <vType id="car" length="{LENGTH}" width="{WIDTH}" maxSpeed="40" speedDev="0" carFollowModel="IDM"/>
</additional>"""


def written(folder, name, text):
    path = os.path.join(folder, name)
    with open(path, "w") as file:
        file.write(text)
    return path


def begin(starts, step):
    lanes = [LANE.format(index, (index - 1) * LANE_WIDTH, LANE_WIDTH) for index in range(3)]
    with tempfile.TemporaryDirectory() as folder:
        road = written(folder, "road.net.xml", NETWORK.format(lanes="\n    ".join(lanes)))
        car = written(folder, "car.add.xml", TYPE)
        libsumo.start(
            ["sumo", "--net-file", road, "--additional-files", car, "--xml-validation", "never"]
            + ["--step-length", str(step), "--lanechange.duration", str(CUT_IN_TAKES)]
            + ["--collision.action", "warn", "--time-to-teleport", "-1", "--no-step-log", "--no-warnings"]
        )
    libsumo.route.add("along", ["road"])
    for name, (s, d, speed) in starts.items():
        front = s + LENGTH / 2
        libsumo.vehicle.add(
            name, "along", "car", departLane=str(lane(d) + 1), departPos=str(front), departSpeed=str(speed)
        )
        libsumo.vehicle.setMaxSpeed(name, speed)
        # Bits of SUMO's: no change of its own will, and none into another vehicle.
        libsumo.vehicle.setLaneChangeMode(name, 0b01_0000_0000)
    # The first step puts the vehicles where they are told to be.
    libsumo.simulationStep()

    def read(now):
        vehicles = {}
        for name in starts:
            x, y = libsumo.vehicle.getPosition(name)
            vehicles[name] = (x - LENGTH / 2, y, libsumo.vehicle.getSpeed(name))
        return now, vehicles

    def drive():
        driven = [read(0.0)]
        for number in range(round(DURATION / step)):
            if number == round(CUT_IN / step):
                libsumo.vehicle.changeLane("cutter", 1, DURATION)
            libsumo.simulationStep()
            driven.append(read((number + 1) * step))
        return driven

    return drive, libsumo.close


measure("SUMO", begin)
