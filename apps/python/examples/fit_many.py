# %% [markdown]
# # Many curves
# A long frame, a row a reading, as loggers write it. Every curve gets a row in the answer, also those that fail.

# %%
import numpy as np
import pandas as pd

import lyrefit

cell = dict(saturation_current=1e-10, n=1.1, resistance_series=0.3, resistance_shunt=300)
parts = []
for string, light in enumerate([1000, 800, 600, 400]):
    curve = lyrefit.simulate(cell, photocurrent=9 * light / 1000, cells_in_series=60, noise_relative=1e-3,
                             seed=string, points=60)
    parts.append(curve.frame().assign(string=f"S{string}", irradiance_Wm2=light))
parts.append(pd.DataFrame({"voltage": [0.0], "current": [9.0], "string": "cut off", "irradiance_Wm2": 1000}))
frame = pd.concat(parts)

# %%
results = lyrefit.fit_many(frame, group="string", cells_in_series=60, temperature_C=25)
table = results.frame()
print(table[["id", "status", "photocurrent", "resistance_series", "p_mp", "rmse_solved_current"]])
print(table.loc[table.status != "fine", ["id", "reason"]])

# %% [markdown]
# One of them in full; all of them from arrays of equal shape.

# %%
print(results["S0"].text)
voltage = np.stack([part.voltage for part in parts[:4]])
current = np.stack([part.current for part in parts[:4]])
same = lyrefit.fit_many(voltage, current, cells_in_series=60, temperature_C=25,
                        irradiance_Wm2=[1000, 800, 600, 400])

# %%
assert list(table.status) == ["fine"] * 4 + ["broken"]
assert (same.frame().photocurrent == table.photocurrent[:4]).all()
