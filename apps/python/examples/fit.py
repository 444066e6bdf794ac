# %% [markdown]
# # One curve, one device
# `fit` takes two arrays, a frame, a file, and answers with a mapping of all that is known.

# %%
import lyrefit

curve = lyrefit.read_curve("data/rtc_france")  # 26 readings of a 57 mm silicon cell at 33 C
print(curve.assumptions)  # what nobody stated

# %%
result = lyrefit.fit(curve.voltage, curve.current, cells_in_series=1, temperature_C=33)
print(result.parameters)  # pvlib's names; ampere and ohm
print(result)  # the whole report; in a notebook `result` alone shows it as a page

# %% [markdown]
# How well each is known, and the error under both labels.

# %%
series = result["parameters"]["resistance_series"]
print(f"Rs = {series['refined']:.4f} ohm, 95 %: {series['low_95']:.4f} to {series['high_95']:.4f}")
print(result["rmse"]["refined"])

# %% [markdown]
# Options are the command's: two diodes, one ideality held, Rs within a range, another seed.

# %%
two = lyrefit.fit(curve, model="dd", fix={"n2": 2}, bound={"Rs": (0, 0.1)}, seed=1)
best = lyrefit.fit(curve, model="auto")
print(best["model_choice"]["sentence"])

# %%
assert abs(result.parameters["resistance_series"] - 0.0365) < 2e-4
result.save_page("fit.html")  # to send to somebody
