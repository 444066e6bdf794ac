"""
One diode, two diodes, or let the data decide
=============================================

``model`` is the number of diodes. ``auto`` fits one, two and three and takes another one only
where the readings support it: by AICc, an F-test and the error on readings that were left out.
"""

import os
import pathlib

import matplotlib.pyplot as plt

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data"
curve = lyrefit.read_curve(data / "rtc_france")
fits = {model: lyrefit.fit(curve, model=model) for model in ("sd", "dd", "td")}
for model, result in fits.items():
    print(model, result["rmse"]["refined"], result["information"]["aicc"])

# %%
# Two diodes with the second ideality fixed at 2, the value of recombination in the depletion
# region.

fixed = lyrefit.fit(curve, model="dd", fix={"n2": 2})
print(fixed.parameters)

# %%
# The choice, in a sentence.

choice = lyrefit.fit(curve, model="auto")["model_choice"]
print(choice["sentence"])
assert choice["chosen"] in fits

# %%
# The residuals show how little the second diode adds here.

for model, result in fits.items():
    plt.plot(curve.voltage, 1e3 * result.residual, "o-", label=model)
plt.axhline(0, color="black", linewidth=0.6)
plt.xlabel("voltage (V)")
plt.ylabel("residual (mA)")
plt.legend(title="model")
plt.show()
