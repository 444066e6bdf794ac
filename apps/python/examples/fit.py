"""
Fit one curve
=============

The five parameters of the single-diode model of a silicon cell of 57 mm diameter at 33 C (RTC
France), from 26 readings. This example needs lyrefit and NumPy; Matplotlib draws the picture.
"""

import numpy as np

import lyrefit

voltage = np.array([
    -0.2057, -0.1291, -0.0588, 0.0057, 0.0646, 0.1185, 0.1678, 0.2132, 0.2545, 0.2924, 0.3269, 0.3585, 0.3873,
    0.4137, 0.4373, 0.459, 0.4784, 0.496, 0.5119, 0.5265, 0.5398, 0.5521, 0.5633, 0.5736, 0.5833, 0.59])
current = np.array([
    0.764, 0.762, 0.7605, 0.7605, 0.76, 0.759, 0.757, 0.757, 0.7555, 0.754, 0.7505, 0.7465, 0.7385,
    0.728, 0.7065, 0.6755, 0.632, 0.573, 0.499, 0.413, 0.3165, 0.212, 0.1035, -0.01, -0.123, -0.21])
result = lyrefit.fit(voltage, current, cells_in_series=1, temperature_C=33)
for name, value in result.parameters.items():
    print(f"{name:20} {value!r}")

# %%
# The names are those of pvlib, in ampere and ohm. Each parameter has its standard error and its 95
# % interval.

series = result["parameters"]["resistance_series"]
print(f"Rs = {series['refined']:.4f} ohm, 95 %: {series['low_95']:.4f} to {series['high_95']:.4f}")
assert series["low_95"] < 0.0364 < series["high_95"]

# %%
# The RMSE has two definitions in the literature; both are given. ``print(result)`` is the whole
# report.

print(result["rmse"]["refined"])

# %%
# The curve of the fit at any voltage is that of ``simulate``.

try:
    import matplotlib.pyplot as plt
except ImportError:
    plt = None
fitted = lyrefit.simulate(result, np.linspace(voltage[0], voltage[-1], 200))
if plt:
    plt.plot(voltage, current, "o", label="measured")
    plt.plot(fitted.voltage, fitted.current, label="single diode")
    plt.xlabel("voltage (V)")
    plt.ylabel("current (A)")
    plt.legend()
    plt.show()
