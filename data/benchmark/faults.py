"""Faults of the made curves. Those of the device change the device; those of the sweep and the instrument are settings
that the sweep (`sweep.py`) carries out. `size` is in [0, 1]: how strong, drawn by the caller."""

import math

import numpy as np

from recipe import section_slices


def changed(device, **what):
    copy = dict(device, arrays={name: array.copy() for name, array in device["arrays"].items()},
                diodes=list(device["diodes"]))
    copy.update(what)
    return copy


def between(low, high, size):
    return low * (high / low) ** size


def sections_hit(draw, device, most):
    count = device["substrings"] * device["modules"]
    first = draw.integer(0, count - 1)
    return [(first + k) % count for k in range(draw.integer(1, min(most, count)))]


def shade(draw, device, size):
    hit = changed(device)
    slices = list(section_slices(device))
    kind = draw.choice(("section", "cells", "edge"))
    loss = between(0.06, 0.95, size)
    if kind == "section":
        for k in sections_hit(draw, device, max(1, len(slices) - 1)):
            for s in slices[k]:
                hit["arrays"]["photocurrent"][s] *= 1 - loss
    elif kind == "cells":
        groups = [s for k in sections_hit(draw, device, 2) for s in slices[k]]
        for s in groups[:draw.integer(1, len(groups))]:
            for k in range(draw.integer(1, 4)):
                hit["arrays"]["photocurrent"][s.start + k] *= 1 - loss * draw.uniform(0.5, 1.0)
    else:
        part = draw.uniform(0.05, 0.35)
        for groups in slices:
            for s in groups:
                end = s.start + max(1, round(part * (s.stop - s.start)))
                hit["arrays"]["photocurrent"][s.start:end] *= 1 - loss * draw.uniform(0.4, 1.0)
    return hit, {"kind": kind}


def bypass_short(draw, device, size):
    del size
    hit = changed(device)
    hit["diodes"][draw.integer(0, len(hit["diodes"]) - 1)] = "short"
    return hit, {}


def bypass_open(draw, device, size):
    hit = changed(device)
    k = draw.integer(0, len(hit["diodes"]) - 1)
    hit["diodes"][k] = False
    groups = list(section_slices(device))[k]
    for s in groups:
        for cell in range(draw.integer(1, 3)):
            hit["arrays"]["photocurrent"][s.start + cell] *= 1 - between(0.1, 0.9, size)
    return hit, {}


def mismatch(draw, device, size):
    hit = changed(device)
    photocurrent = hit["arrays"]["photocurrent"]
    if draw.chance(0.5):
        scatter = np.abs(draw.normals(len(photocurrent), between(0.015, 0.08, size)))
        photocurrent *= np.clip(1 - scatter, 0.3, 1)
        return hit, {"kind": "scatter"}
    lost = between(0.05, 0.5, size)
    for _ in range(draw.integer(1, max(1, len(photocurrent) // 15))):
        cell = draw.integer(0, len(photocurrent) - 1)
        part = lost * draw.uniform(0.3, 1.0)
        for name in ("photocurrent", "i01", "i02"):
            hit["arrays"][name][cell] *= 1 - part
        hit["arrays"]["rs"][cell] *= 1 + 3 * part
    return hit, {"kind": "cracks"}


def series_resistance(draw, device, size):
    del draw
    nominal = device["nominal"]
    unit = 0.65 * device["cells"] * device["modules"] / (nominal["photocurrent"] * device["groups"])
    return changed(device, resistance=between(0.02, 0.25, size) * unit), {}


def shunt(draw, device, size):
    hit = changed(device)
    rsh = hit["arrays"]["rsh"]
    conductance = between(0.03, 0.5, size) * device["nominal"]["photocurrent"] / 0.55
    kind = draw.choice(("all", "graded", "few"))
    weight = np.ones(len(rsh))
    if kind == "graded":
        weight = np.linspace(0, 2, len(rsh)) ** 2
    elif kind == "few":
        weight = np.zeros(len(rsh))
        for _ in range(draw.integer(1, max(1, len(rsh) // 8))):
            weight[draw.integer(0, len(rsh) - 1)] = draw.uniform(1, 4)
    hit["arrays"]["rsh"] = 1 / (1 / rsh + conductance * weight)
    return hit, {"kind": kind}


def light(draw, size):
    kind = draw.choice(("step", "drift", "dip"))
    sign = -1 if draw.chance(0.5) else 1
    return {"kind": kind, "part": sign * between(0.015, 0.15, size), "at": draw.uniform(0.1, 0.85),
            "width": draw.uniform(0.03, 0.10)}


def sensor(draw, conditions, size):
    stated = dict(conditions)
    if draw.chance(0.5):
        stated["irradiance_Wm2"] = conditions["true_irradiance_Wm2"] / (1.12 + 0.4 * size)
        return stated, {"kind": "irradiance"}
    sign = -1 if draw.chance(0.5) else 1
    stated["temperature_C"] = conditions["true_temperature_C"] + sign * (14 + 20 * size)
    return stated, {"kind": "temperature"}


def hysteresis(size):
    return {"part": between(0.01, 0.08, size)}


def clip(size):
    return {"part": 1 - between(0.02, 0.25, size)}


def range_change(draw, size):
    sign = -1 if draw.chance(0.5) else 1
    return {"gain": 1 + sign * between(0.015, 0.06, size), "below": draw.uniform(0.2, 0.8)}


DEVICE = {"shade": shade, "bypass_short": bypass_short, "bypass_open": bypass_open, "mismatch": mismatch,
          "series_resistance": series_resistance, "shunt": shunt}


def power_lost(healthy, faulty):
    """Part of the power at the maximum power point that the fault takes, noise-free."""
    return 1 - faulty["imp_A"] * faulty["vmp_V"] / (healthy["imp_A"] * healthy["vmp_V"])


def misfit(volts, healthy, faulty, isc):
    return math.sqrt(float(np.mean(((faulty - healthy) / isc) ** 2)))
