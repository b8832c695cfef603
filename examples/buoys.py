"""Fifty buoys without a simulator: each decides by itself from what it measures and what it hears."""

import math
import random

import shoal

scenario = shoal.load("oceans2020")
buoys = [shoal.Buoy(scenario, id) for id in range(scenario.agents)]
speeds = [fleet.max_speed for fleet in scenario.fleets for _ in range(fleet.count)]

# What stands for the sea here: where the buoys are, and one target that lies still.
chance = random.Random(1)
readings = [shoal.Reading(chance.uniform(-8, 8), chance.uniform(-8, 8), 0.0, 0.0, False) for _ in buoys]
target_x, target_y, target_radius = 3.0, -2.0, 1.0

seen = 0
for step in range(200):
    air = [buoy.report(reading, step).to_bytes() for buoy, reading in zip(buoys, readings, strict=True)]
    inbox = [shoal.Report.from_bytes(data, buoys[0].told) for data in air]  # here, every radio reaches everybody
    moved = []
    for buoy, (x, y, *_) in zip(buoys, readings, strict=True):
        vx, vy, _ = buoy.decide(readings[buoy.id], inbox, step)
        assert math.hypot(vx, vy) <= speeds[buoy.id] * (1 + 1e-12)
        x = min(max(x + vx * scenario.time_step, -buoy.briefing.half_x), buoy.briefing.half_x)
        y = min(max(y + vy * scenario.time_step, -buoy.briefing.half_y), buoy.briefing.half_y)
        moved.append(shoal.Reading(x, y, vx, vy, math.hypot(x - target_x, y - target_y) <= target_radius))
    readings = moved
    seen += any(reading.on_target for reading in readings)

print(
    f"{sum(reading.on_target for reading in readings)} of {len(buoys)} buoys are on target; {seen} of 200 steps one was"
)
