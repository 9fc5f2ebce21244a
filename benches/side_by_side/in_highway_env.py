"""The scenario in highway-env: `python in_highway_env.py TRACE` prints a line per step length (see scenario.py).

Its road is stepped as its environments do it, `act` and `step`, without observations, rewards or pictures. All five
vehicles follow by IDM with its own parameters; MOBIL is off, so that nobody but the cutter changes lanes. Its own y axis
points to the right.
"""

from highway_env.road.lane import StraightLane
from highway_env.road.road import Road, RoadNetwork
from highway_env.vehicle.behavior import IDMVehicle

from scenario import CUT_IN, DURATION, LANE_WIDTH, measure


def begin(starts, step):
    network = RoadNetwork()
    for right in (-1, 0, 1):
        y = right * LANE_WIDTH
        network.add_lane("a", "b", StraightLane([0, y], [2000, y], width=LANE_WIDTH, speed_limit=40))
    road = Road(network)
    vehicles = {}
    for name, (s, d, speed) in starts.items():
        vehicles[name] = IDMVehicle(road, [s, -d], speed=speed, target_speed=speed, enable_lane_change=False)
    road.vehicles = list(vehicles.values())

    def read(now):
        return now, {name: (v.position[0], -v.position[1], v.speed) for name, v in vehicles.items()}

    def drive():
        driven = [read(0.0)]
        for number in range(round(DURATION / step)):
            if number == round(CUT_IN / step):
                vehicles["cutter"].target_lane_index = ("a", "b", 1)
            road.act()
            road.step(step)
            driven.append(read((number + 1) * step))
        return driven

    def end():
        if any(vehicle.crashed for vehicle in road.vehicles):
            raise SystemExit("highway-env reports a crash")

    return drive, end


measure("highway-env", begin)
