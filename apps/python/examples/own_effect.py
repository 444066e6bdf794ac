"""
An effect of your own
=====================

What the diode model lacks, as a function of arrays: here a shunt whose current grows with the
square of the voltage. It is simulated, fitted with an interval, and tried by a diagnosis like the
effects of the catalogue.
"""

import matplotlib.pyplot as plt
import numpy as np

import lyrefit


def square(voltage, s):
    """Current into the junction, in parts of Isc, at the voltage of one cell."""
    return -s * np.abs(voltage) * voltage


strength = {"bounds": (0, 1), "unit": "A/V2", "current_power": 1}
shunt = lyrefit.Effect("square_shunt", {"s": strength}, junction=square,
                       title="shunt that grows with the voltage")
device = {"Iph": 8.2, "Is1": 2e-9, "n1": 1.15, "Rs": 0.25, "Rsh": 300.0}
voltage = np.linspace(-10, 37, 70)
curve = lyrefit.simulate(device, voltage, cells_in_series=60, temperature_C=25, noise_A=1e-3,
                         with_=(shunt, {"s": 0.5}))

# %%
# Found again by a fit, with its interval. Derivatives of the function, ``junction_derivatives``,
# would make it faster.

without, fit = lyrefit.fit(curve), lyrefit.fit(curve, with_=shunt)
found = fit["parameters"]["square_shunt.s"]
print(f"s = {found['refined']:.4f} A/V2, 95 %: {found['low_95']:.4f} to {found['high_95']:.4f}")
assert found["low_95"] <= 0.5 <= found["high_95"]

# %%
# A diagnosis tries it beside others. In the laboratory mode every reading has an independent error
# and every size counts.

verdict = lyrefit.diagnose(curve, effects=[shunt, "second_diode"], held_out=False, noise="white",
                           floor_current=0, floor_power=0)
print(verdict.sentence)
assert verdict.causes == ["square_shunt"]

# %%
# The residuals without it and with it.

plt.plot(voltage, 1e3 * without.residual, ".-", label="diode alone")
plt.plot(voltage, 1e3 * fit.residual, ".-", label="with the effect")
plt.xlabel("voltage (V)")
plt.ylabel("residual (mA)")
plt.legend()
plt.show()
