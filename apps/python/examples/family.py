# %% [markdown]
# One device behind many curves: De Soto's law fitted to all of them at once, and what pvlib makes of it.

# %%
import os
import pathlib

import numpy as np
import pandas as pd

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data"

# %% A folder of curves, as the command reads it
result = lyrefit.fit_family(data / "s75_constructed", family="desoto", folds=0, individual_fits=False)
print(result.parameter_frame()[["parameter", "refined", "low_95", "high_95", "unit"]])
print(result.frame().head())

# %% The device as pvlib takes it: calcparams_desoto(1000, 25, **result.pvlib["parameters"])
print(result.pvlib["parameters"])

# %% [markdown]
# The same from one long frame: a row a reading, with the curve's id and what the sensors said.

# %%
device = {"Iph": 0.7608, "Is1": 3.1e-7, "n1": 1.477, "Rs": 0.0365, "Rsh": 52.9}
rows = []
for light in (400.0, 700.0, 1000.0):
    own = dict(device, Iph=device["Iph"] * light / 1000)
    curve = lyrefit.simulate(own, irradiance_Wm2=light, temperature_C=33, points=30, noise_A=2e-4, seed=int(light))
    rows.append(curve.frame().assign(curve=int(light), irradiance=light, temperature=33.0))
frame = pd.concat(rows)
made = lyrefit.fit_family(frame, shunt="constant", folds=0, individual_fits=False)
print(made.parameters)
assert np.isclose(made.parameters["R_s"], device["Rs"], rtol=0.05)
