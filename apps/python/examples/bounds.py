"""
Bounds, and what the readings say without them
==============================================

A fit searches a box. The default box follows from the curve; published ones are known by name, and single ranges can be
set. Here the series resistance is held back by a bound that is too low, and the report says so.
"""

import os
import pathlib

import matplotlib.pyplot as plt
import numpy as np

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data"
curve = lyrefit.read_curve(data / "rtc_france")
for box in ("physical", "literature", {"Iph": (0, 1), "Is": (0, 1e-6), "n": (1, 2), "Rs": (0, 0.03), "Rsh": (0, 100)}):
    result = lyrefit.fit(curve, bounds=box)
    series = result["parameters"]["resistance_series"]
    print(f"Rs = {series['refined']:.5f} ohm, at a bound: {series['at_bound']}")
assert series["at_bound"] and series["bound_side"] == "upper"

# %%
# The RMSE with Rs fixed at a series of values shows what the bound costs. The 95 % interval of the default fit comes from a
# profile of this kind.

free = lyrefit.fit(curve)
series = free["parameters"]["resistance_series"]
values = np.linspace(0.028, 0.045, 35)
rmse = [lyrefit.fit(curve, fix={"Rs": value}, intervals="none")["rmse"]["refined"]["solved_current_A"] for value in values]
plt.plot(values, 1e3 * np.array(rmse), label="RMSE with Rs fixed")
plt.axvspan(series["low_95"], series["high_95"], alpha=0.2, label="95 % interval")
plt.axvline(0.03, color="C1", linestyle="--", label="the bound that is too low")
plt.plot(series["refined"], 1e3 * free["rmse"]["refined"]["solved_current_A"], "o", color="C0", label="optimum")
plt.xlabel("series resistance (ohm)")
plt.ylabel("RMSE, solved-current (mA)")
plt.legend()
plt.show()
