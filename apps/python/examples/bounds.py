"""
Bounds, and what the readings say without them
==============================================

A fit searches a box. The default box follows from the curve; published ones are known by name, and
single ranges can be set. Here the series resistance is held back by a bound that is too low, and
the report says so.
"""

import os
import pathlib

import matplotlib.pyplot as plt
import numpy as np

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data"
curve = lyrefit.read_curve(data / "rtc_france")
physical = lyrefit.fit(curve)
literature = lyrefit.fit(curve, bounds="literature")
own = lyrefit.fit(curve, bound={"Rs": (0, 0.03)})
for result in (physical, literature, own):
    series = result["parameters"]["resistance_series"]
    print(f"Rs = {series['refined']:.5f} ohm, at a bound: {series['at_bound']}")
assert series["at_bound"] and series["bound_side"] == "upper"

# %%
# The RMSE with Rs fixed at a series of values shows what the bound costs. The 95 % interval of the
# default fit comes from a profile of this kind.

series = physical["parameters"]["resistance_series"]
values = np.linspace(0.028, 0.045, 35)
fits = [lyrefit.fit(curve, fix={"Rs": value}, intervals="none") for value in values]
rmse = [1e3 * result["rmse"]["refined"]["solved_current_A"] for result in fits]
plt.plot(values, rmse, label="RMSE with Rs fixed")
plt.axvspan(series["low_95"], series["high_95"], alpha=0.2, label="95 % interval")
plt.axvline(0.03, color="C1", linestyle="--", label="the bound that is too low")
plt.xlabel("series resistance (ohm)")
plt.ylabel("RMSE, solved-current (mA)")
plt.legend()
plt.show()
