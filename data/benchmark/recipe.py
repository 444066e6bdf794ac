"""What the made curves of the benchmark are drawn from: devices, conditions, faults, instruments.

A curve depends on the seed (bytes) and its number alone. Random numbers come from Python's Mersenne twister through
random() only, whose stream is the same in every version of Python.
"""

import hashlib
import math
import random

import numpy as np

import simulator

# Named cause, probability, what else is a right name for it. The shares are known to all; the order is not.
CAUSES = {
    "none": (0.48, ()),
    "shade": (0.10, ()),
    "bypass_short": (0.05, ()),
    "bypass_open": (0.05, ("shade",)),
    "mismatch": (0.07, ()),
    "series_resistance": (0.06, ()),
    "shunt": (0.06, ()),
    "light": (0.06, ()),
    "sensor": (0.03, ()),
    "hysteresis": (0.02, ()),
    "clip": (0.01, ()),
    "range": (0.01, ()),
}
SMALLEST_MISFIT = 0.006  # of Isc, rms over the sweep, between the curve with its fault and without


class Draw:
    """Numbers of one curve."""

    def __init__(self, seed, number, part):
        digest = hashlib.sha256(seed + f"/{part}/{number}".encode()).digest()
        self.uniform01 = random.Random(int.from_bytes(digest, "big")).random

    def uniform(self, low, high):
        return low + (high - low) * self.uniform01()

    def log_uniform(self, low, high):
        return low * (high / low) ** self.uniform01()

    def normal(self, sd=1.0):
        return sd * math.sqrt(-2 * math.log(1 - self.uniform01())) * math.cos(2 * math.pi * self.uniform01())

    def normals(self, count, sd=1.0):
        return np.array([self.normal(sd) for _ in range(count)])

    def integer(self, low, high):
        return low + min(int(self.uniform01() * (high - low + 1)), high - low)

    def chance(self, probability):
        return self.uniform01() < probability

    def choice(self, values):
        return values[self.integer(0, len(values) - 1)]

    def weighted(self, weights):
        left = self.uniform01() * sum(weights.values())
        for name, weight in weights.items():
            left -= weight
            if left < 0:
                return name
        return name


# Cells in series, substrings of a module (sections under one bypass diode), groups of a section in parallel.
LAYOUTS = ((36, 2, 1), (48, 3, 1), (60, 3, 1), (60, 3, 1), (72, 3, 1), (72, 3, 1), (54, 3, 2), (60, 3, 2), (72, 3, 2),
           (96, 3, 1))


def draw_device(draw):
    """A healthy module type, how many of it are in series, and every cell of it."""
    cells, substrings, groups = draw.choice(LAYOUTS)
    modules = draw.choice((1, 1, 1, 1, 1, 2, 3, 4, 6, 8))
    plain = draw.chance(0.22)  # equal cells of one diode: five parameters describe it exactly
    if plain:
        groups = 1
    voc = draw.uniform(0.60, 0.74)  # of a cell, near open circuit
    isc = draw.uniform(3.0, 13.0)
    n1 = draw.uniform(1.0, 1.35) if plain else draw.uniform(1.0, 1.12)
    vt = simulator.thermal_voltage(25.0)
    share2 = 0.0 if plain else draw.log_uniform(0.01, 0.25)  # of the current at Voc that the second diode takes
    cell = {
        "photocurrent": isc / groups,
        "i01": (1 - share2) * isc / groups / math.expm1(voc / (n1 * vt)),
        "n1": n1,
        "i02": share2 * isc / groups / math.expm1(voc / (2 * vt)),
        "rs": draw.uniform(0.004, 0.016) * voc / isc * groups * 2.5,
        "rsh": draw.log_uniform(60, 3000) * voc / isc * groups,
        "breakdown_part": 0.0 if plain else draw.log_uniform(1e-3, 0.2),
        "breakdown_V": -draw.uniform(12, 28),
        "breakdown_m": draw.uniform(2.5, 4.0),
    }
    spread = {name: 0.0 for name in cell}
    if not plain:
        spread.update(photocurrent=draw.uniform(0.002, 0.008), i01=draw.uniform(0.02, 0.10), rs=0.06,
                      rsh=draw.uniform(0.1, 0.5), breakdown_part=0.3)
    count = cells * groups * modules
    arrays = {}
    for name, value in cell.items():
        scatter = draw.normals(count, spread[name]) if spread[name] else np.zeros(count)
        scatter = np.clip(scatter, -3 * spread[name], 3 * spread[name])
        arrays[name] = value * (np.exp(scatter) if name != "photocurrent" else 1 + scatter)
    return {"cells": cells, "substrings": substrings, "groups": groups, "modules": modules, "plain": plain,
            "nominal": cell, "arrays": arrays,
            "bypass": (draw.log_uniform(1e-9, 1e-6), 1.05), "diodes": [True] * (substrings * modules), "resistance": 0.0}


def section_slices(device):
    """For each section the index ranges of its groups, in the order of the string."""
    each = device["cells"] // device["substrings"]
    for section in range(device["substrings"] * device["modules"]):
        start = section * each * device["groups"]
        yield [slice(start + g * each, start + (g + 1) * each) for g in range(device["groups"])]


def curve_of(device, conditions, light=1.0):
    """The curve of the device under a light of so many parts of its stated true irradiance."""
    arrays = dict(device["arrays"])
    suns = conditions["true_irradiance_Wm2"] / 1000 * light
    arrays["photocurrent"] = arrays["photocurrent"] * suns
    arrays = simulator.at_temperature(arrays, conditions["true_temperature_C"])
    sections = []
    for groups, whole in zip(section_slices(device), device["diodes"]):
        bypass = {True: device["bypass"], False: None, "short": (1e9, 1.0)}[whole]
        sections.append(([{k: a[s] for k, a in arrays.items()} for s in groups], bypass))
    shorted = [k for k, whole in enumerate(device["diodes"]) if whole == "short"]
    sections = [s for k, s in enumerate(sections) if k not in shorted]
    return simulator.string_curve(sections, conditions["true_temperature_C"], device["resistance"])


def draw_conditions(draw):
    irradiance, temperature = draw.uniform(250, 1100), 0.0
    temperature = draw.uniform(0, 30) + 0.028 * irradiance
    return {"true_irradiance_Wm2": irradiance, "true_temperature_C": temperature,
            "irradiance_Wm2": irradiance * (1 + draw.normal(0.01)), "temperature_C": temperature + draw.normal(1.0)}


def sheet_of(draw, device):
    """Rated values of the module type: those of its nominal cell, off by what production scatters."""
    nominal = dict(device, modules=1, diodes=[True] * device["substrings"], resistance=0.0)
    count = device["cells"] * device["groups"]
    nominal["arrays"] = {name: np.full(count, value) for name, value in device["nominal"].items()}
    standard = {"true_irradiance_Wm2": 1000.0, "true_temperature_C": 25.0}
    values = simulator.key_values(curve_of(nominal, standard))
    warm = simulator.key_values(curve_of(nominal, dict(standard, true_temperature_C=45.0)))
    currents, voltages = 1 + draw.normal(0.010), 1 + draw.normal(0.004)
    return {"isc_A": round(values["isc_A"] * currents, 2), "voc_V": round(values["voc_V"] * voltages, 2),
            "imp_A": round(values["imp_A"] * currents, 2), "vmp_V": round(values["vmp_V"] * voltages, 2),
            "alpha_isc_percent_K": 0.05,
            "beta_voc_percent_K": round((warm["voc_V"] / values["voc_V"] - 1) / 20 * 100, 3)}
