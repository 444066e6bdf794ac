# %% [markdown]
# What a diode model gets wrong in a measurement, and why.

# %%
import os
import pathlib

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data" / "diagnosis"

# %% One sweep: the verdict first
found = lyrefit.diagnose(data / "shaded_module.csv", extend=True, held_out=False)
print(found.sentence)
for cause in found["verdict"]["causes"]:
    print(cause["id"], cause["in_words"])
assert found.causes == ["shading"]

# %% Every candidate, tried or not, and why not
print(found.frame()[["effect", "tried", "probability", "why_not"]].head(8))

# %% The model with its causes is a fit like any other
assert found.extended is not None
print(found.extended.parameters)

# %% [markdown]
# Against its own history: a sweep of today beside reference sweeps of the same module.

# %%
against = lyrefit.diagnose(data / "sweep_now.csv", reference=data / "sweeps", held_out=False)
print(against.brief)

# %% In a notebook the result shows itself as a page
assert found._repr_html_().lstrip().startswith("<!DOCTYPE html>")
