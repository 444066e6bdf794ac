# %% [markdown]
# # The curve of a device
# The current is solved to rounding at each voltage; pvlib's names, pvlib's units.

# %%
import numpy as np

import lyrefit

module = dict(photocurrent=8.2, saturation_current=2e-10, nNsVth=1.6, resistance_series=0.35, resistance_shunt=400)
curve = lyrefit.simulate(module, cells_in_series=60)
print(curve.frame().describe())

# %% [markdown]
# At voltages of one's own, with an instrument's noise, with a shaded cell.

# %%
voltage = np.linspace(0, 36, 73)
clean = lyrefit.simulate(module, voltage, cells_in_series=60)
noisy = lyrefit.simulate(module, voltage, cells_in_series=60, noise_A=0.005, seed=1)
shaded = lyrefit.simulate(module, voltage, cells_in_series=60, with_={"shading": {"d": 0.3, "w": 0.3333}})
print(np.std(noisy.current - clean.current))

# %% [markdown]
# What a fit says, at other voltages.

# %%
result = lyrefit.fit(noisy)
between = lyrefit.simulate(result, np.linspace(25, 30, 11))
print(between.current)

# %%
exact = lyrefit.simulate(result, noisy.voltage).current
assert np.abs(exact - clean.current).max() < 0.01
assert (shaded.current <= clean.current + 1e-12).all()
