# %% [markdown]
# How low the RMSE of a curve can go, proved, of the measured and of the solved current.

# %%
import os
import pathlib

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data"

# %% The floor is that of any number of diodes; beside it the best each model can do
proof = lyrefit.certify(data / "rtc_france")
print(proof.frame().T)
assert proof.certified

# %% A fit stands against it
fit = lyrefit.fit(data / "rtc_france", objective="measured-current")
best = next(model for model in proof["models"] if model["model"] == "sd")
above = fit["rmse"]["refined"]["measured_current_A"] / best["rmse_A"] - 1
print(f"the fit is {above:.1e} above what is possible")
assert above < 1e-9

# %% The same of the solved current, which fits minimise unless told otherwise
solved = lyrefit.certify(data / "rtc_france", objective="solved-current", models=["sd"])
assert solved.certified
print(f"solved-current: nothing below {solved['models'][0]['lower_bound_A']:.9e} A")
beside = lyrefit.fit(data / "rtc_france", floor=True)["floor"]
assert beside["objective"] == "solved-current"
print(f"the fit lies {100 * beside['refined_above']:.2f} % above what any number of diodes reaches")
