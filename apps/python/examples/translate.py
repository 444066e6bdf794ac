# %% [markdown]
# A measured curve at standard or any other conditions, with its uncertainty.

# %%
import os
import pathlib

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data"
curve = lyrefit.read_curve(data / "diagnosis" / "shaded_module.csv", irradiance_Wm2=870, temperature_C=41)

# %% Every procedure that the data allow stands side by side; three of them here
result = lyrefit.translate(curve, to=(1000, 25), procedures=["iec1", "iec2", "desoto"], alpha="0.05%", beta="-0.29%",
                           draws=2000)
print(result.frame().T)

# %% The one to go by, with expanded uncertainties (k = 2)
best = result.recommended
assert best is not None
print(best["title"], best["key_points"]["max_power_W"], "W")
for row in best["budget"]["results"]:
    print(f"{row['name']:<26}{row['value']:10.4f} +- {row['expanded_uncertainty']:.4f} {row['unit']}")

# %% A field test: is it within its rating?
tested = lyrefit.translate(curve, procedures="iec1", alpha="0.05%", beta="-0.29%", rated_W=500, tolerance="-0,+3",
                           irradiance_from="reference-cell", temperature_from="back", draws=2000)
print(tested["field_test"]["sentence"])
assert tested["field_test"]["pass"]
