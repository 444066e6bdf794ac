#!/usr/bin/env python3
"""Figures that rank_tests_test.cc expects, from SciPy and from first principles.

    python3 rank_tests_reference.py

Friedman and the normal approximation of Wilcoxon are SciPy's; the exact p-value of Wilcoxon counts all
2^n signs one by one; Dunn's pairs take the variance of the ranks from the ranks themselves.
"""
import itertools

import numpy as np
from scipy import stats

BLOCKS = {  # compared by compared, one value a block
    "Plain": [
        [0.91, 0.85, 0.77, 0.94, 0.60, 0.71, 0.83, 0.66, 0.79, 0.88],
        [0.95, 0.80, 0.81, 0.97, 0.72, 0.75, 0.89, 0.70, 0.78, 0.93],
        [0.99, 0.90, 0.79, 1.05, 0.81, 0.70, 0.95, 0.74, 0.86, 0.98],
    ],
    "Tied": [
        [1, 2, 2, 1, 3, 2, 1, 2],
        [2, 2, 3, 1, 3, 2, 4, 3],
        [3, 2, 4, 5, 3, 6, 4, 4],
        [3, 5, 1, 5, 3, 7, 4, 5],
        [4, 5, 6, 7, 8, 7, 9, 6],
    ],
    "MostlyTied": [
        [1, 1, 1, 1, 1, 1],
        [1, 1, 2, 1, 1, 1],
        [1, 1, 2, 1, 3, 1],
        [1, 1, 2, 2, 3, 1],
    ],
}

PAIRS = {
    "Plain": (
        [125, 115, 130, 140, 140, 115, 140, 125, 140, 135],
        [110, 122, 127, 120, 144, 124, 123, 137, 135, 148],
    ),
    "TiedWithZeros": (
        [5, 7, 3, 9, 6, 8, 4, 7, 5, 6, 9, 2, 8, 7],
        [3, 7, 4, 5, 4, 6, 4, 8, 3, 4, 5, 3, 5, 7],
    ),
    "OneSizeOnly": (
        [2, 3, 4, 5, 6, 7, 8, 9, 10],
        [1, 2, 3, 4, 5, 6, 7, 8, 11],
    ),
}


def holm(p):
    p = np.asarray(p)
    m = len(p)
    order = np.argsort(p, kind="stable")
    stepped = [(m - i) * p[k] for i, k in enumerate(order)]
    corrected = np.empty(m)
    for i, k in enumerate(order):
        corrected[k] = min(1.0, max(stepped[: i + 1]))
    return corrected


def blocks(name, values):
    values = np.array(values, float)
    k, b = values.shape
    ranks = np.array([stats.rankdata(values[:, j]) for j in range(b)])
    test = stats.friedmanchisquare(*values)
    print(f"{name}: mean ranks {ranks.mean(axis=0).tolist()}")
    print(f"  chi-square {test.statistic:.15g}, p {test.pvalue:.15g}")
    deviation = np.sqrt(2 * ranks.var(axis=1, ddof=1).mean() / b)
    pairs = list(itertools.combinations(range(k), 2))
    differences = np.array([ranks[:, i].mean() - ranks[:, j].mean() for i, j in pairs])
    p = 2 * stats.norm.sf(np.abs(differences) / deviation)
    half = stats.norm.isf((1 - 0.95 ** (1 / len(pairs))) / 2) * deviation
    print(f"  half-width of the intervals {half:.15g}")
    for (i, j), d, one, h in zip(pairs, differences, p, holm(p)):
        sidak = 1 - (1 - one) ** len(pairs)
        print(f"  {{{i}, {j}, {d:.15g}, {one:.13g}, {sidak:.13g}, {h:.13g}}},")


def signed_ranks(name, first, second):
    d = np.array(first, float) - np.array(second, float)
    d = d[d != 0]
    ranks = stats.rankdata(np.abs(d))
    plus, minus = ranks[d > 0].sum(), ranks[d < 0].sum()
    low = min(plus, minus)
    count = sum(np.dot(signs, ranks) <= low for signs in itertools.product((0, 1), repeat=len(d)))
    exact = min(1.0, 2 * count / 2 ** len(d))
    normal = stats.wilcoxon(first, second, zero_method="wilcox", correction=False, mode="approx")
    print(f"{name}: pairs {len(d)}, plus {plus}, minus {minus}")
    print(f"  exact {exact:.15g} ({count} of 2^{len(d)}), normal {normal.pvalue:.15g}")


for name, values in BLOCKS.items():
    blocks(name, values)
for name, (first, second) in PAIRS.items():
    signed_ranks(name, first, second)
one_sign = np.arange(1.0, 31.0)
print(f"thirty of one sign: normal "
      f"{stats.wilcoxon(-one_sign, correction=False, mode='approx').pvalue:.15g}")
many = np.array([(i * 37 % 101 - 40) or 1 for i in range(250)], float)
print(f"250 pairs: normal {stats.wilcoxon(many, correction=False, mode='approx').pvalue:.15g}")
