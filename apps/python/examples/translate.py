"""
To standard conditions, with the uncertainty
============================================

A sweep at 870 W/m2 and 41 C carried to 1000 W/m2 and 25 C by procedures of IEC 60891 and by De
Soto's law, each with its budget of uncertainty; and a field test against the rating.
"""

import os
import pathlib

import matplotlib.pyplot as plt

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data"
curve = lyrefit.read_curve(data / "diagnosis" / "shaded_module.csv", irradiance_Wm2=870, temperature_C=41)
result = lyrefit.translate(curve, to=(1000, 25), procedures=["iec1", "iec2", "desoto"],
                           alpha="0.05%", beta="-0.29%")
for done in result["results"]:
    power = next(row for row in done["budget"]["results"] if row["name"] == "max_power")
    print(f"{done['title']:28} {power['value']:.1f} W +- {power['expanded_uncertainty']:.1f} W (k = 2)")
assert result.recommended is not None

# %%
# Is it within its rating of 500 W, -0 to +3 %? The answer counts the uncertainty.

tested = lyrefit.translate(curve, procedures="iec1", alpha="0.05%", beta="-0.29%",
                           rated_W=500, tolerance="-0,+3",
                           irradiance_from="reference-cell", temperature_from="back")
print(tested["field_test"]["sentence"])
assert tested["field_test"]["pass"]

# %%
# The measured curve and its translations.

plt.plot(curve.voltage, curve.current, ".", color="C5", label="measured, 870 W/m2, 41 C")
for done in result["results"]:
    plt.plot(done["points"]["voltage_V"], done["points"]["current_A"], label=done["title"])
plt.xlim(0, 64)
plt.ylim(0, 14)
plt.xlabel("voltage (V)")
plt.ylabel("current (A)")
plt.legend(loc="lower left")
plt.show()
