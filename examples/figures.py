"""Draw every figure of a record that there is, for a paper (.svg, .pdf) or a page (.png)."""

import shoal
from shoal import plot

scenario = shoal.load("oceans2020", steps=3000)
record = shoal.simulate(scenario, runs=3, out="record")

plot.save(plot.summary(record), "summary.png")  # as shoal run --figure
plot.save(plot.snapshot(record, links=True), "snapshot.svg")
plot.save(plot.snapshot(record, step=2800, halos=True, trail=0), "repulsion.png")
plot.save(plot.trajectory_map(record, start=2900, steps=60), "paths.png")
plot.save(plot.time_on_target(record), "time-on-target.pdf")

slow = shoal.simulate(scenario, fleets=scenario.fleets[1:])
plot.save(plot.phi_histogram({"mixed": record, "all slow": slow}), "heading.svg")

simulation = shoal.Simulation(scenario)
simulation.advance(500)
plot.save(plot.snapshot(simulation), "now.png")
print("drawn: summary, snapshots, paths, time on target, headings")
