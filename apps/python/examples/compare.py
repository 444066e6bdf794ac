# %% [markdown]
# Search algorithms against each other, one of them written here.

# %%
import os
import pathlib

import numpy as np

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data"


# %% A search gets the objective (the RMSE in A), the box, and how much it may spend
def halving(objective, lower, upper, options):
    """Random points in a box that closes in on the best of them."""
    random = np.random.default_rng([options["seed"], options["run"]])
    centre, width = (lower + upper) / 2, upper - lower
    best, value = centre, objective(centre)
    for _ in range(options["iterations"]):
        points = np.clip(centre + width * (random.random((options["population"], len(lower))) - 0.5), lower, upper)
        values = objective(points)
        if values.min() < value:
            best, value = points[values.argmin()], values.min()
        centre, width = best, width * 0.9
    return best


# %%
result = lyrefit.compare(data / "rtc_france", models="sd", runs=10, population=20, iterations=50,
                         algorithms=["mlo", "de", "random", halving])
print(result.frame()[["algorithm", "rank_searched", "rank_polished", "median_searched_A", "within_1e9"]])

# %% After the polish they hardly differ: that is the point of it
assert (result.frame()["within_1e9"] >= 9).all()
