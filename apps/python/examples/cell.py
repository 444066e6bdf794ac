"""
A laboratory cell
=================

All measurements of one cell together: sweeps at five lights, lit and dark, and a Suns-Voc trace.
They say what one curve cannot: the ideality at each light, the series resistance by several
methods, and where the fill factor is lost.
"""

import os
import pathlib

import matplotlib.pyplot as plt

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data" / "cell"
cell = lyrefit.cell([data / name for name in ("lights.csv", "lit_dark.csv", "suns.csv")])
print(cell.brief)

# %%
# The series resistance by each method. The cell was made with 6 ohm.

for found in cell["resistance_series"]:
    if found["ohm"] is not None:
        print(f"{found['ohm']:8.3f} ohm  {found['method']}")
joint = cell["joint"]["parameters"]["resistance_series"]
assert abs(joint["refined"] - 6) < 0.01

# %%
# The fill factor from its ideal value to what was measured, a loss at a time.

losses = cell["fill_factor_losses"][0]
left = 100 * losses["ideal"]
plt.barh("n = 1, no resistances", left, color="C2")
for part in losses["parts"]:
    loss = 100 * part["loss"]["value"]
    left -= loss
    plt.barh(part["name"], loss, left=left, color="C1")
plt.barh("measured", 100 * losses["measured"], color="C0")
plt.gca().invert_yaxis()
plt.xlim(74, 89)
plt.xlabel("fill factor (%)")
plt.show()
