#!/usr/bin/env python3
"""Scores an entry of the contest cwhanse/ivcurves as its published rules and scorer do, written anew after them.

    contest_score.py ENTRY TRUTH [--json FILE]

ENTRY and TRUTH: folders with case1.csv, case2.csv, case3a.csv, ...: Index and six parameters a row. Needs mpmath.

Exact sets: ten points of the fitted curve, evenly spaced in voltage from 0 to its Voc; each against the point of the
known curve on the ray from the origin through it: the root of the sum of both squared relative distances, summed over
points and curves. The last point is the fitted curve's (Voc, 0), and the known one beside it has a current that is 0 but
for rounding. The scorer divides by that current if it is not exactly 0, so the point counts 1 or more, or next to nothing,
as the last digit falls: "at Voc" below is the sum of these points, "elsewhere" that of all others.
Noisy sets: the sum of |known - fitted| / known over the parameters.
"""

import argparse
import csv
import json
import pathlib
import sys

from mpmath import mp

mp.dps = 40
TOLERANCE = mp.mpf("1e-16")
THERMAL = mp.mpf("1.380649e-23") * mp.mpf(298.15) / mp.mpf("1.602176634e-19")
NAMES = ("photocurrent", "saturation_current", "resistance_series", "resistance_shunt", "n", "cells_in_series")
EXACT, NOISY = ("case1", "case2"), ("case3a", "case3b", "case3c", "case3d")
POINTS = 10


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return {int(row["Index"]): [mp.mpf(row[name]) for name in NAMES] for row in csv.DictReader(file)}


def excess(device, v, i):
    """Right minus left side of the single diode equation."""
    iph, i0, rs, rsh, n, cells = device
    across = v + i * rs
    return iph - i0 * mp.expm1(across / (n * cells * THERMAL)) - across / rsh - i


def current(device, v):
    """By Lambert's W; once more by a root search where that is not to the tolerance, as the scorer does."""
    iph, i0, rs, rsh, n, cells = device
    width, share = n * cells * THERMAL, rs / rsh + 1
    w = mp.lambertw(rs * i0 / (width * share) * mp.exp((rs * (iph + i0) + v) / (width * share))).real
    i = (iph + i0 - v / rsh) / share - width / rs * w
    if abs(excess(device, v, i)) > TOLERANCE:
        i = mp.findroot(lambda y: excess(device, v, y), i, tol=TOLERANCE ** 2)
    return i


def open_circuit(device):
    iph, i0, _, rsh, n, cells = device
    width = n * cells * THERMAL
    w = mp.lambertw(i0 * rsh / width * mp.exp((iph + i0) * rsh / width)).real
    return (iph + i0) * rsh - width * w


def on_ray(device, end, v, i):
    """Voltage at which the ray through (v, i) meets the curve: golden section, then a secant search, on -|excess|."""
    def depth(x):
        return -abs(excess(device, x, i / v * x))

    low, high = mp.mpf(0), end
    part = (3 - mp.sqrt(5)) / 2
    for _ in range(100):
        left, right = low + part * (high - low), low + (1 - part) * (high - low)
        if depth(left) > depth(right):
            found, done, high = left, abs(right - low) < TOLERANCE, right
        else:
            found, done, low = right, abs(high - left) < TOLERANCE, left
        if done:
            break
    return mp.findroot(depth, found, tol=TOLERANCE ** 2, maxsteps=100)


def distance(known, fitted):
    parts = [(f - k) / k if k != 0 else mp.mpf(0) for k, f in zip(known, fitted)]
    return mp.sqrt(parts[0] ** 2 + parts[1] ** 2)


def exact_score(known, fitted):
    """What the last point adds, and what all others do."""
    end, last = open_circuit(known), open_circuit(fitted)
    others = mp.mpf(0)
    for k in range(POINTS - 1):
        v = mp.mpf(float(last) * (k / (POINTS - 1)))
        i = current(fitted, v)
        x = mp.mpf(0) if v == 0 else on_ray(known, end, v, i)
        others += distance((x, current(known, x)), (v, i))
    x = on_ray(known, end, last, mp.mpf(0))
    return distance((x, current(known, x)), (last, mp.mpf(0))), others


def noisy_score(known, fitted):
    return sum(abs(k - f) / k for k, f in zip(known, fitted))


def score(entry, truth):
    scores = {}
    for name in EXACT + NOISY:
        known, fitted = read(truth / f"{name}.csv"), read(entry / f"{name}.csv")
        if known.keys() != fitted.keys():
            raise ValueError(f"{entry / name}.csv: expected the indices {sorted(known)}, got {sorted(fitted)}")
        if name in NOISY:
            scores[name] = {"score": float(sum(noisy_score(known[k], fitted[k]) for k in known))}
            continue
        parts = [exact_score(known[k], fitted[k]) for k in known]
        scores[name] = {"score": float(sum(a + b for a, b in parts)), "at_voc": float(sum(a for a, _ in parts)),
                        "elsewhere": float(sum(b for _, b in parts)), "curves": len(parts),
                        "counted_1": sum(bool(a > 0.5) for a, _ in parts)}
    return scores


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("entry", type=pathlib.Path)
    parser.add_argument("truth", type=pathlib.Path)
    parser.add_argument("--json", type=pathlib.Path)
    given = parser.parse_args()
    try:
        scores = score(given.entry, given.truth)
    except (OSError, ValueError, KeyError) as error:
        sys.exit(str(error))
    print("| set | score | at Voc | elsewhere | curves whose last point counts 1 |\n|---|---|---|---|---|")
    for name, s in scores.items():
        beside = (f"{s['at_voc']:.6g} | {s['elsewhere']:.3g} | {s['counted_1']} of {s['curves']}"
                  if "curves" in s else " | | ")
        print(f"| {name} | {s['score']:.6g} | {beside} |")
    if given.json:
        given.json.write_text(json.dumps(scores, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
