#!/usr/bin/env python3
"""What the rule of averaging and the draw of the noise make of the noisy sets' scores.

    averages.py TEST_SETS

Fits the 50 curves of each noisy set by plain least squares and with errors found from the residuals, and prints the score
of several means of the same fits, and the 95 % range of the entry's mean over 2,000 draws of the 50 fits with replacement.
`import lyrefit` must work.
"""

import csv
import json
import math
import pathlib
import random
import statistics
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "entry"))

import lyrefit_entry as entry  # noqa: E402

NAMES = entry.COLUMNS


def score(truth, mean):
    return sum(abs(truth[name] - mean[name]) / truth[name] for name in NAMES)


def arithmetic(fits):
    return {name: statistics.fmean(fit[name] for fit in fits) for name in NAMES}


def median(fits):
    return {name: statistics.median(fit[name] for fit in fits) for name in NAMES}


def geometric(fits):
    return {name: math.exp(statistics.fmean(math.log(max(fit[name], 1e-300)) for fit in fits)) for name in NAMES}


def drawn_range(truth, fits):
    draw = random.Random(1).random
    scores = sorted(score(truth, entry.mean_of([fits[int(draw() * len(fits))] for _ in fits])) for _ in range(2000))
    return scores[50], scores[1949]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sets = pathlib.Path(sys.argv[1])
    print("| set | errors | mean, of 1/Rsh | 95 % over draws | mean, of Rsh | median | geometric mean |\n|---|---|---|---|---|---|---|")
    for name in ("case3a", "case3b", "case3c", "case3d"):
        test_set = json.loads((sets / f"{name}.json").read_text(encoding="utf-8"))
        with open(sets / f"{name}.csv", newline="", encoding="utf-8") as file:
            truth = {key: float(value) for key, value in next(csv.DictReader(file)).items()}
        for noisy, errors in ((False, "least squares"), (True, "found")):
            fits = [entry.fit_curve(curve, test_set["cells_in_series"], noisy) for curve in test_set["IV Curves"]]
            low, high = drawn_range(truth, fits)
            others = " | ".join(f"{score(truth, mean(fits)):.4g}" for mean in (arithmetic, median, geometric))
            print(f"| {name} | {errors} | {score(truth, entry.mean_of(fits)):.4f} | {low:.3f} to {high:.3f} | {others} |")


if __name__ == "__main__":
    main()
