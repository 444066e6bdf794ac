"""
Hysteresis of a pair of sweeps
==============================

A perovskite cell answers a sweep down otherwise than a sweep up. An index of hysteresis compares
powers or areas; where the curves cross, such an index hides most of the gap between them, so the
gap is given as well.
"""

import os
import pathlib

import matplotlib.pyplot as plt
import numpy as np

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data" / "cell"
cell = lyrefit.cell(data / "pair.csv")
found = cell["hysteresis"][0]
for key in ("index_power", "index_area", "index_at_80"):
    print(f"{key:12} {100 * found[key]:.2f} %")
print(f"gap          {found['gap_percent']:.2f} % of Jsc, of which noise {found['noise_percent']:.2f} %")
print("crossing:", found["cross"], "- possible causes:", ", ".join(found["causes"]))
assert found["cross"] and found["gap_percent"] > 10 * found["noise_percent"]

# %%
# Both sweeps, and the difference that the index by power sums up as 2.3 %.

sweeps = {key: cell["sweeps"][found[key]] for key in ("reverse", "forward")}
density = {}
above, below = plt.subplots(2, 1, sharex=True, gridspec_kw={"height_ratios": (2, 1)})[1]
for key, sweep in sweeps.items():
    voltage = np.array(sweep["data"]["voltage_V"])
    density[key] = voltage, 1e3 * np.array(sweep["data"]["current_A"]) / cell["area_cm2"]
    above.plot(*density[key], label=f"{key}: {100 * sweep['efficiency']:.2f} %")
order = np.argsort(density["forward"][0])
forward = np.interp(density["reverse"][0], *(values[order] for values in density["forward"]))
below.plot(density["reverse"][0], density["reverse"][1] - forward, color="C2")
above.set(ylabel="current density (mA/cm2)", ylim=(-5, 24))
below.set(xlabel="voltage (V)", ylabel="difference", ylim=(-2.5, 2.5))
above.legend(title="efficiency")
plt.show()
