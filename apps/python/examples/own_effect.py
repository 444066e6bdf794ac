# %% [markdown]
# An effect of your own: what the diode model lacks, as a function of arrays. It is fitted, simulated and
# diagnosed like those of the catalogue.

# %%
import numpy as np

import lyrefit

device = {"Iph": 8.2, "Is1": 2e-9, "n1": 1.15, "Rs": 0.25, "Rsh": 300.0}
voltage = np.linspace(-10, 37, 70)


# %% A shunt that grows with the square of the voltage: current in parts of Isc over volts of one cell
def square(voltage, s):
    return -s * np.abs(voltage) * voltage


shunt = lyrefit.Effect("square_shunt", {"s": {"bounds": (0, 1), "unit": "A/V2", "current_power": 1}}, junction=square,
                       title="shunt that grows with the voltage")

# %% Simulated ...
curve = lyrefit.simulate(device, voltage, cells_in_series=60, temperature_C=25, with_=(shunt, {"s": 0.5}), noise_A=1e-3)

# %% ... and found again, with an interval
without = lyrefit.fit(curve)
fit = lyrefit.fit(curve, with_=shunt)
print(without["rmse"]["refined"]["solved_current_A"], "->", fit["rmse"]["refined"]["solved_current_A"])
found = fit["parameters"]["square_shunt.s"]
print(found["refined"], found["low_95"], found["high_95"])
assert found["low_95"] <= 0.5 <= found["high_95"]


# %% Derivatives of its own make it faster and exact; without them they are differences
def slopes(voltage, s):
    return {"voltage": -2 * s * np.abs(voltage), "s": -np.abs(voltage) * voltage}


exact = lyrefit.Effect("square_shunt", {"s": {"bounds": (0, 1), "unit": "A/V2", "current_power": 1}}, junction=square,
                       junction_derivatives=slopes)
assert np.isclose(lyrefit.fit(curve, with_=exact).parameters["resistance_series"],
                  fit.parameters["resistance_series"], rtol=1e-6)

# %% A diagnosis tries it beside others; as on a bench every reading has its own error alone, and all counts
verdict = lyrefit.diagnose(curve, effects=[shunt, "second_diode"], held_out=False, noise="white",
                           floor_current=0, floor_power=0)
print(verdict.sentence)
assert verdict.causes == ["square_shunt"]
