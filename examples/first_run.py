"""Run the paper's scenario five times, shortened, and read the result."""

import shoal

record = shoal.simulate("oceans2020", steps=5000, runs=5)
mean, interval, runs = record.estimate("time_on_target")
print(f"time on target {mean:.3f} [{interval[0]:.3f}, {interval[1]:.3f}], a 95 % interval over {len(runs)} runs")
print("agents per step from away (-1) to toward (+1):", record.phi_histogram().sum(axis=0).round(2))
