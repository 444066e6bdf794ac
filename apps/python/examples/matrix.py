"""
A test report: the matrix of IEC 61853-1
========================================

A laboratory measures Isc, Voc and the maximum power point over irradiance and temperature. These
key points alone determine the reference parameters of PVsyst's law, with the error of every
condition.
"""

import os
import pathlib

import matplotlib.pyplot as plt
import numpy as np

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data"
result = lyrefit.fit_family(data / "formats" / "matrix_long.csv", family="pvsyst", cells_in_series=60)
print(result.parameter_frame()[["parameter", "refined", "low_95", "high_95", "unit"]].to_string(index=False))
points = result["key_points"]
print(f"rms error of Pmp: {100 * points['rms']['max_power']:.2f} %, of conditions that were left out in turn: "
      f"{100 * points['rms']['held_out_max_power_of_reference']:.2f} % of {points['reference_power_W']:.1f} W")
assert points["rms"]["max_power"] < 0.005

# %%
# The error of each condition, beside that of a fit which did not see it.

frame = result.frame()
place = np.arange(len(frame))
measured = np.array([row["measured"]["max_power_W"] for row in frame.key_points])
fitted = np.array([row["model"]["max_power_W"] for row in frame.key_points])
left_out = np.array([row["held_out_power_W"]["value"] for row in frame.key_points])
plt.bar(place - 0.2, 100 * (fitted / measured - 1), 0.4, label="fitted")
plt.bar(place + 0.2, 100 * (left_out / measured - 1), 0.4, label="left out")
plt.xticks(place, [name.replace(", ", "\n") for name in frame.id])
plt.ylabel("error of Pmp (%)")
plt.legend()
plt.show()
