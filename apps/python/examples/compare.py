"""
Your optimizer beside twelve others, with the proved floor
==========================================================

A search of your own is a function of ten lines. It gets the objective (the RMSE in A of one point
or of many), the box and its budget, and returns its best point. ``compare`` runs it beside the
library's eight and four of ``lyrefit.searches``, all from the same points and budget, and ranks
them. With these bounds the saturation current and the shunt are searched as logarithms, as
``options["parameters"]`` says; in the linear boxes of publications (``bounds="literature"``) the
searches rank otherwise.
"""

import os
import pathlib

import matplotlib.pyplot as plt
import numpy as np

import lyrefit
from lyrefit import searches

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data"


def mine(objective, lower, upper, options):
    """Normal steps around the best point so far, smaller by the iteration."""
    random = np.random.default_rng([options["seed"], options["run"]])
    values = objective(options["start"])  # where the library's searches start as well
    best, value = options["start"][values.argmin()], values.min()
    for step in np.geomspace(0.5, 1e-4, options["iterations"]):
        moves = random.standard_normal((options["population"], len(lower)))
        points = np.clip(best + step * (upper - lower) * moves, lower, upper)
        values = objective(points)
        if values.min() < value:
            best, value = points[values.argmin()], values.min()
    return best


others = ["mlo", "lo", "lo+mblss", "lo+dmlss", "mlo+vector", "mlo+shape", "de", "random", searches.cma_es,
          searches.particle_swarm, searches.grey_wolf, searches.simulated_annealing]
result = lyrefit.compare(data / "rtc_france", models="sd", algorithms=[mine, *others],
                         runs=20, population=20, iterations=250)
table = result.frame().sort_values("rank_searched")
shown = ["algorithm", "rank_searched", "median_searched_A", "rank_polished", "within_1e9"]
print(table[shown].to_string(index=False))

# %%
# The certificate: no single diode within the bounds has a lower RMSE, so the distance from it is
# known, not estimated.

reference = result["problems"][0]["reference"]
print(f"{reference['rmse_A']:.9e} A: {reference['origin']}")
print(f"{reference['floor_A']:.9e} A: floor of any number of diodes")
assert len(table) == 13 and (table.within_1e9 == 20).all()  # after the polish all reach it

# %%
# The searches alone, best rank first. After the polish all runs of all of them end at the proved
# optimum.

plt.barh(table.algorithm, table.median_searched_A / table.reference_A - 1,
         color=["C1" if name == "mine" else "C0" for name in table.algorithm])
plt.gca().invert_yaxis()
plt.xscale("log")
plt.xlabel("median distance from the proved optimum (relative)")
plt.show()
