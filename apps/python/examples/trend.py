"""
What changed over a year
========================

356 sweeps of one module over a year, with gaps, dust and sensors that drift. Each is reduced to
standard conditions; a step or an onset is claimed where a series without one would hardly ever
show as much.
"""

import os
import pathlib

import matplotlib.pyplot as plt
import pandas as pd

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data" / "trend"
trend = lyrefit.trend(data / "year.csv")
print(trend["verdict"])
for onset in trend["onsets"]:
    print(f"{onset['date']} ({onset['date_low']} to {onset['date_high']}): {onset['cause']}")
assert trend["onsets"][0]["id"] == "lost_substrings"  # a bypass diode failed on 15 June

# %%
# What each part costs, in percent of the energy that the unchanged module would have given.

for part, loss in trend["loss"]["energy_percent"].items():
    print(f"{part:18} {loss['value']:6.2f} % ({loss['low_95']:.2f} to {loss['high_95']:.2f})")

# %%
# The losses day by day, with the dates of the onsets.

days = trend.frame()
time = pd.to_datetime(days.time)
parts = ("light", "resistance_series", "mismatch")
for part in parts:
    plt.plot(time, days[f"loss_{part}_percent"], ".-", label=part.replace("_", " "))
for onset in trend["onsets"]:
    plt.axvline(pd.Timestamp(onset["date"]), color="black", linestyle=":", linewidth=1)
plt.ylabel("loss of power (%)")
plt.legend(loc="center left")
plt.gcf().autofmt_xdate()
plt.show()
