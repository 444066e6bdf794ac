"""
Tables and figures of a paper
=============================

What a paper on a search needs of one comparison: the table of errors and the table of mean ranks in LaTeX, the convergence
of every search (the author's own among them) as PDF, and the BibTeX of all that the comparison used. Every number is of the
same runs.
"""

import os
import pathlib
import tempfile
import warnings

import matplotlib.pyplot as plt
import numpy as np

import lyrefit
from lyrefit import searches

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data"
folder = tempfile.TemporaryDirectory()  # or one of your own that stays
paper = pathlib.Path(folder.name)


def mine(objective, lower, upper, options):
    """Steps towards the best point so far, with the spread of the population."""
    random = np.random.default_rng([options["seed"], options["run"]])
    points, values = options["start"], objective(options["start"])
    for _ in range(options["iterations"]):
        best = points[values.argmin()]
        moved = points + random.random(points.shape) * (best - points) + 0.5 * points.std(0) * random.standard_normal(points.shape)
        moved = np.clip(moved, lower, upper)
        found = objective(moved)
        points = np.where((found < values)[:, None], moved, points)
        values = np.minimum(found, values)
    return points[values.argmin()]


result = lyrefit.compare([data / "rtc_france", data / "pwp201"], models="sd",
                         algorithms=[mine, "mlo", "de", searches.particle_swarm],
                         bounds="literature", constants="literature", runs=15, population=20, iterations=200)

# %%
# The table of errors: the smallest, mean and largest RMSE of the searches alone, in A, and their standard deviation.

table = result.frame().set_index(["curve", "algorithm"])
errors = table[["min_searched_A", "mean_searched_A", "max_searched_A", "std_searched_A"]]
errors.columns = ["min (A)", "mean (A)", "max (A)", "std (A)"]
with warnings.catch_warnings():  # pandas 1 announces its version 2
    warnings.simplefilter("ignore", FutureWarning)
    latex = errors.to_latex(float_format="%.4e", caption="RMSE of the searches, 15 runs each", label="tab:rmse")
(paper / "errors.tex").write_text(latex, encoding="utf-8")
print(latex)

# %%
# The mean ranks, which the tests of Friedman, Dunn and Wilcoxon in ``result.text`` are about.

ranks = table["rank_searched"].unstack("curve")
print(ranks.to_string(float_format="%.2f"))
print(f"{result['problems'][0]['ranking']['searched']['friedman']['p_value']:.1e}: p of equal searches on the first curve")

# %%
# The figures, as PDF: convergence, and the runs as boxes. LaTeX takes them by ``\\includegraphics``.

result.save_plot(paper / "convergence.pdf", kind="convergence")
result.save_plot(paper / "runs.pdf")
print(sorted(file.name for file in paper.iterdir()))

# %%
# The same median traces as numbers, for a figure drawn by hand.

for algorithm in result["problems"][0]["algorithms"]:
    trace = algorithm["median_trace"]
    above = np.array(trace["best_A"]) / result["problems"][0]["reference"]["rmse_A"] - 1
    plt.loglog(trace["evaluations"], np.maximum(above, 1e-10), label=algorithm["name"])
plt.xlabel("evaluations")
plt.ylabel("median distance from the proved optimum (relative)")
plt.legend()
plt.show()

# %%
# What to cite: the software and every method that the comparison used. A line ``% missing: ...`` names what no source at
# hand states.

bibtex = lyrefit.cite(result)
(paper / "methods.bib").write_text(bibtex, encoding="utf-8")
print(bibtex[:bibtex.index("\n\n")])
assert all(key in bibtex for key in ("lyrefit,", "storn1997,", "clerc2002,", "friedman1937,", "easwarakhanthan1986,"))
