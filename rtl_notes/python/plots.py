"""Pulse counts of a stepper axis and a weld seam of a robot, in plots.

Run it as a script, or cell by cell in an editor that knows ``# %%``. The pictures go into the
directory of the first argument, or into ``build/plots``.
"""

# %%
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import motion_rtl as mr

pictures = Path(sys.argv[1] if len(sys.argv) > 1 else "build/plots")
pictures.mkdir(parents=True, exist_ok=True)

# %% [markdown]
# Half-periods of 1 to 250 ticks, one after the other, each in a unit time of 1000 ticks. The
# circuit takes the half-period in the last tick of the unit time before; tick 0 is a unit time of
# its own. Step begins each unit time low.

# %%
T = 1000
half_periods = np.arange(1, 251)
axis = mr.Model("unit_law", width=16)
inputs = {"half_period": np.append(np.repeat(half_periods, T), 0), "period": T}
step = axis.run(inputs, watch=["step"])["step"][1:].reshape(-1, T)
counts = np.count_nonzero(step[:, 1:] & ~step[:, :-1], axis=1)
assert np.array_equal(counts, ((T - 1) // half_periods + 1) // 2), "the count law"

# %%
figure, (above, below) = plt.subplots(2, layout="constrained")
shown = (125, 100, 80)
for row, n in enumerate(shown):
    above.step(np.arange(T), step[n - 1] * 0.8 + row, where="post")
above.set_yticks([row + 0.4 for row in range(len(shown))], [f"n = {n}" for n in shown])
above.set(xlabel="tick of the unit time", title="Step pulses")
below.loglog(half_periods, T / (2 * half_periods), "--", label="T / 2n")
below.loglog(half_periods, counts, ".", label="circuit")
below.set(xlabel="half-period n in ticks", ylabel="pulses in a unit time")
below.legend()
figure.savefig(pictures / "pulse_counts.png")

# %% [markdown]
# A weld seam at three feeds: positions of the torch, and its distance from the commanded point.

# %%
runs = {feed: mr.Job("waves/weld.toml", feed_mm_per_min=feed).run() for feed in (300, 600, 1200)}
for feed, run in runs.items():
    assert run.exact, run.summary["complaints"]


# %%
figure = plt.figure(figsize=(9, 4), layout="constrained")
path = figure.add_subplot(1, 2, 1, projection="3d")
speeds = figure.add_subplot(1, 2, 2)
for feed, run in runs.items():
    counts_per_mm = run.summary["settings"]["counts_per_mm"]
    x, y, z = (run.series[f"{axis}_actual_counts"] / counts_per_mm for axis in "xyz")
    path.plot(x, y, z, label=f"{feed} mm/min")
    speed = np.linalg.norm(np.diff([x, y, z]), axis=0) / np.diff(run.series["time_s"])
    speeds.plot(run.series["time_s"][1:], speed * 60, label=f"{feed} mm/min")
path.view_init(elev=50, azim=50)
path.set_box_aspect(None, zoom=0.85)
path.set(xlabel="x in mm", ylabel="y in mm", zlabel="z in mm", title="Torch")
speeds.set(xlabel="time in s", ylabel="speed in mm/min", title="From rest to rest")
speeds.legend()
figure.savefig(pictures / "weld.png")
