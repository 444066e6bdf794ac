"""
One device behind many curves
=============================

Seven curves of one module at five irradiances and three temperatures, fitted together. A law (here
De Soto's) says how the five parameters follow light and temperature, so that one set of reference
parameters has to describe all curves.
"""

import os
import pathlib

import matplotlib.pyplot as plt
import pandas as pd

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data"
result = lyrefit.fit_family(data / "s75_constructed", family="desoto")
print(result.parameter_frame()[["parameter", "refined", "low_95", "high_95", "unit"]].to_string(index=False))

# %%
# The same parameters as pvlib takes them: ``calcparams_desoto(1000, 25,
# **result.pvlib["parameters"])``.

print(result.pvlib["parameters"])
assert abs(result.parameters["R_s"] - 0.2819) < 1e-3  # the module was constructed with this one

# %%
# Each curve with the current of the common device. A long frame of your own, a row a reading with
# the columns ``curve``, ``irradiance`` and ``temperature``, is taken in the place of the folder.

readings = pd.read_csv(data / "s75_constructed" / "curves.csv", dtype={"curve": str})
for number, row in result.frame().iterrows():
    own = readings[readings.curve == row.id]
    condition = f"{row.irradiance_Wm2:.0f} W/m2, {row.temperature_C:.0f} C"
    plt.plot(own.voltage_V, own.current_A, ".", color=plt.cm.tab10(number), label=condition)
    plt.plot(own.voltage_V, own.current_A + row.residual_A, color=plt.cm.tab10(number))
plt.xlabel("voltage (V)")
plt.ylabel("current (A)")
plt.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1, 1))
plt.show()
