"""
A module against its own past
=============================

Some changes leave a healthy-looking curve: series resistance that grows, for one. Earlier sweeps
of the same module show them. Nineteen reference sweeps say what this module gives at the light of
today, and how far it scatters.
"""

import os
import pathlib

import matplotlib.pyplot as plt

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data" / "diagnosis"
alone = lyrefit.diagnose(data / "sweep_now.csv", held_out=False)
print("alone:", alone.sentence)
against = lyrefit.diagnose(data / "sweep_now.csv", reference=data / "sweeps", held_out=False)
compared = against["comparison"]
print("against its past:", compared["sentence"])
assert not alone.causes and compared["causes"][0]["id"] == "series_resistance"

# %%
# What is compared: now, expected at the Isc and Voc of today, and the difference in standard
# deviations.

for row in compared["rows"]:
    print(f"{row['name']:34} {row['now']:9.4g} {row['expected']:9.4g} {row['unit']:4} {row['z']:+6.1f}")

# %%
# The change was made by 8 % more series resistance; the fill factor falls with it.

rows = compared["rows"]
plt.barh([row["name"] for row in rows], [row["z"] for row in rows],
         color=["C1" if row["differs"] else "C5" for row in rows])
plt.gca().invert_yaxis()
plt.axvspan(-3, 3, alpha=0.15, color="C2")
plt.xlabel("difference from the references (standard deviations)")
plt.show()
