"""One made curve: draws device, conditions and cause, sweeps it as an instrument does, and keeps the truth."""

import hashlib

import numpy as np

import faults
import recipe
import simulator


def draw_instrument(draw):
    return {"current_noise": draw.log_uniform(1e-4, 1.5e-3),  # of Isc
            "voltage_noise": draw.log_uniform(2e-5, 6e-4),  # of Voc
            "flicker": draw.log_uniform(1e-4, 1.2e-3),  # of the light, from reading to reading related
            "bits": draw.integer(12, 16), "points": draw.integer(40, 160),
            "loads": draw.chance(0.3),  # steps of a load, else of the voltage
            "falling": draw.chance(0.4), "both": draw.chance(0.15)}


def voltages_of(curve, keys, instrument):
    """Where the instrument reads, rising: from just above short circuit to open circuit."""
    end = keys["voc_V"] * 0.998
    if not instrument["loads"]:
        return np.linspace(0.0, end, instrument["points"])
    angles = np.linspace(0.02, np.pi / 2 - 0.01, instrument["points"])
    grid = np.linspace(0.0, end, 3000)
    slope = np.arctan2(grid / keys["voc_V"], np.maximum(np.interp(grid, *curve), 0) / keys["isc_A"])
    return np.interp(angles, slope, grid)


def wander(draw, count, size):
    """Light that wanders: an autoregressive path of that standard deviation."""
    path, value = np.empty(count), draw.normal(size)
    for k in range(count):
        value = 0.95 * value + draw.normal(size * (1 - 0.95 ** 2) ** 0.5)
        path[k] = value
    return path


def moved_light(count, setting):
    """Light over the sweep, in parts of its start, as readings are taken."""
    u = np.linspace(0, 1, count)
    if setting["kind"] == "step":
        return 1 + setting["part"] * (u > setting["at"])
    if setting["kind"] == "drift":
        return 1 + 1.5 * setting["part"] * u
    return 1 - abs(setting["part"]) * 1.5 * np.exp(-0.5 * ((u - setting["at"]) / setting["width"]) ** 2)


def currents_under(device, conditions, volts, light):
    """Currents at these voltages, each under its own light: a parabola through three full solutions."""
    low, high = min(float(light.min()), 0.995), max(float(light.max()), 1.005)
    levels = [low, 0.5 * (low + high), high]
    at = [simulator.current_at(recipe.curve_of(device, conditions, level), volts) for level in levels]
    total = np.zeros_like(volts)
    for k in range(3):
        weight = np.ones_like(light)
        for other in range(3):
            if other != k:
                weight = weight * (light - levels[other]) / (levels[k] - levels[other])
        total += weight * at[k]
    return total


def swept(case, instrument, noise):
    """Voltages, currents and sweep numbers as read. Noise: a draw, or None for the readings without any error."""
    keys = case["keys"]
    rising = voltages_of(case["curve"], keys, instrument)
    both = instrument["both"] or case["cause"] == "hysteresis"
    sweeps = [rising, rising[::-1]] if both else [rising]
    if instrument["falling"]:
        sweeps = [v[::-1] for v in sweeps]
    volts = np.concatenate(sweeps)
    numbers = np.concatenate([np.full(len(v), k) for k, v in enumerate(sweeps)])
    light = moved_light(len(volts), case["setting"]) if case["cause"] == "light" else np.ones(len(volts))
    if noise is not None:
        light = light * (1 + wander(noise, len(volts), instrument["flicker"]))
    currents = currents_under(case["device"], case["conditions"], volts, light)
    if case["cause"] == "hysteresis":  # charge of the junctions: it grows with the voltage as their current does
        direction = np.concatenate([np.full(len(v), 1.0 if v[-1] > v[0] else -1.0) for v in sweeps])
        charge = np.exp((volts / keys["voc_V"] - 1) * 9)
        currents = currents - direction * case["setting"]["part"] * keys["isc_A"] * (0.15 + charge)
    if case["cause"] == "range":
        below = currents < case["setting"]["below"] * keys["isc_A"]
        currents = np.where(below, currents * case["setting"]["gain"], currents)
    if noise is not None:
        currents = currents + noise.normals(len(currents), instrument["current_noise"] * keys["isc_A"])
        volts = volts + noise.normals(len(volts), instrument["voltage_noise"] * keys["voc_V"])
        current_step = 1.25 * keys["isc_A"] / 2 ** instrument["bits"]
        voltage_step = 1.25 * keys["voc_V"] / 2 ** instrument["bits"]
        currents = np.round(currents / current_step) * current_step
        volts = np.maximum(np.round(volts / voltage_step) * voltage_step, 0.0)
    if case["cause"] == "clip":
        currents = np.minimum(currents, case["setting"]["part"] * keys["isc_A"])
    return volts, currents, numbers


def with_cause(draw, device, conditions, cause, size):
    """The case of a cause of that size, and what else is known of it."""
    case = {"cause": cause, "device": device, "conditions": conditions, "setting": {}}
    if cause in faults.DEVICE:
        case["device"], case["setting"] = faults.DEVICE[cause](draw, device, size)
    elif cause == "sensor":
        case["conditions"], case["setting"] = faults.sensor(draw, conditions, size)
    elif cause == "light":
        case["setting"] = faults.light(draw, size)
    elif cause == "hysteresis":
        case["setting"] = faults.hysteresis(size)
    elif cause == "clip":
        case["setting"] = faults.clip(size)
    elif cause == "range":
        case["setting"] = faults.range_change(draw, size)
    case["curve"] = recipe.curve_of(case["device"], case["conditions"])
    case["keys"] = simulator.key_values(case["curve"])
    return case


def drawn_case(draw, device, conditions, instrument, cause):
    """A case whose fault bends the curve by at least SMALLEST_MISFIT of Isc; the size grows until it does."""
    healthy = with_cause(draw, device, conditions, "none", 0)
    if cause == "none":
        return healthy, healthy, 0.0
    size = draw.uniform(0, 1)
    while True:
        case = with_cause(draw, device, conditions, cause, size)
        clean = dict(instrument, both=instrument["both"] or cause == "hysteresis")
        volts, with_fault, _ = swept(case, clean, None)
        without = simulator.current_at(healthy["curve"], volts)
        misfit = faults.misfit(volts, without, with_fault, healthy["keys"]["isc_A"])
        if cause == "sensor" or misfit >= recipe.SMALLEST_MISFIT:
            return case, healthy, misfit
        size = min(1.0, size + 0.1)


def truth_of(cause, case, healthy, misfit):
    truth = {"cause": cause, "accepted": sorted({cause, *recipe.CAUSES[cause][1]}),
             "misfit_percent_isc": round(100 * misfit, 3), "setting": case["setting"], "parameters": {}}
    if cause == "mismatch" and case["setting"]["kind"] == "cracks":
        truth["accepted"] = ["mismatch", "shade"]  # a cell that lost area is a cell with less light
    if cause in faults.DEVICE or cause == "none":
        truth["parameters"]["power_lost"] = faults.power_lost(healthy["keys"], case["keys"])
    if cause == "none" and case["device"]["plain"]:
        truth["parameters"].update(plain_parameters(case["device"], case["conditions"]))
    return truth


def plain_parameters(device, conditions):
    """The five parameters of a device of equal cells of one diode. A curve tells n times the temperature: the true n is
    that of the temperature as stated."""
    at = simulator.at_temperature(device["arrays"], conditions["true_temperature_C"])
    first = {name: float(array[0]) for name, array in at.items()}
    cells = device["cells"] * device["modules"]
    thermal = [simulator.thermal_voltage(t) for t in (conditions["true_temperature_C"],
                                                      round(conditions["temperature_C"], 1))]
    return {"photocurrent": first["photocurrent"] * conditions["true_irradiance_Wm2"] / 1000,
            "saturation_current": first["i01"], "n": first["n1"] * thermal[0] / thermal[1],
            "resistance_series": cells * first["rs"], "resistance_shunt": cells * first["rsh"]}


def made_curve(seed, number):
    """The record of a curve as it is published, and its truth."""
    draw = recipe.Draw(seed, number, "curve")
    cause = draw.weighted({name: share for name, (share, _) in recipe.CAUSES.items()})
    device = recipe.draw_device(draw)
    while cause in ("bypass_short", "bypass_open") and device["plain"] and device["modules"] > 4:
        device = recipe.draw_device(draw)
    conditions = recipe.draw_conditions(draw)
    instrument = draw_instrument(draw)
    case, healthy, misfit = drawn_case(draw, device, conditions, instrument, cause)
    volts, currents, numbers = swept(case, instrument, recipe.Draw(seed, number, "noise"))
    record = {"id": "m" + hashlib.sha256(seed + f"/id/{number}".encode()).hexdigest()[:10], "part": "made",
              "cells_in_series": device["cells"] * device["modules"], "modules_in_series": device["modules"],
              "substrings": device["substrings"] * device["modules"], "groups_in_parallel": device["groups"],
              "irradiance_Wm2": round(case["conditions"]["irradiance_Wm2"], 1),
              "temperature_C": round(case["conditions"]["temperature_C"], 1), "sheet": recipe.sheet_of(draw, device),
              "voltage_V": [float(f"{v:.6g}") for v in volts], "current_A": [float(f"{i:.6g}") for i in currents]}
    if len(set(numbers.tolist())) > 1:
        record["sweep"] = [int(k) for k in numbers]
    truth = {"id": record["id"], **truth_of(cause, case, healthy, misfit)}
    return record, truth
