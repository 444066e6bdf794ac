"""Currents of modules and strings of cells that differ, for the curves of the benchmark.

Every cell is two diodes, a shunt and Bishop's reverse breakdown (doi:10.1016/0379-6787(88)90059-2), laid out over its
junction voltage, where its current is explicit. Cells in series add their voltages at common currents; groups in
parallel and the bypass diode of a section, itself a diode, add their currents at common voltages. Nothing is solved by
iteration, no code is shared with lyrefit. Currents in A, voltages in V, resistances in ohm, generator convention.
"""

import numpy as np

K_PER_Q = 8.617333262e-5  # V/K
ABSOLUTE_ZERO_C = -273.15
BAND_GAP_EV = 1.12

# What a cell is: one number a cell each.
CELL_FIELDS = ("photocurrent", "i01", "n1", "i02", "rs", "rsh", "breakdown_part", "breakdown_V", "breakdown_m")


def thermal_voltage(temperature_C):
    return K_PER_Q * (temperature_C - ABSOLUTE_ZERO_C)


def at_temperature(cells, temperature_C):
    """The cells, described at 25 C, at another temperature."""
    t, t0 = temperature_C - ABSOLUTE_ZERO_C, 25.0 - ABSOLUTE_ZERO_C
    exponent = BAND_GAP_EV / K_PER_Q * (1 / t0 - 1 / t)
    moved = dict(cells)
    moved["photocurrent"] = cells["photocurrent"] * (1 + 5e-4 * (temperature_C - 25.0))
    moved["i01"] = cells["i01"] * ((t / t0) ** 3 * np.exp(exponent)) ** (1 / cells["n1"])
    moved["i02"] = cells["i02"] * (t / t0) ** 2.5 * np.exp(exponent / 2)
    return moved


def junction_voltages(breakdown_V):
    """A row a cell: close to breakdown first, dense where the diodes conduct."""
    reverse = 1 - np.geomspace(1e-3, 1.0, 240)
    forward = np.concatenate([np.linspace(0, 0.4, 160, endpoint=False), np.linspace(0.4, 0.95, 1100)])
    return np.concatenate([breakdown_V[:, None] * reverse[None, :-1], np.tile(forward, (len(breakdown_V), 1))], axis=1)


def cell_curves(cells, temperature_C):
    """Terminal voltages (rising) and currents (falling) of every cell, a row each."""
    vt = thermal_voltage(temperature_C)
    column = {name: np.asarray(cells[name], float)[:, None] for name in CELL_FIELDS}
    vj = junction_voltages(np.asarray(cells["breakdown_V"], float))
    shunt = vj / column["rsh"]
    reverse = np.minimum(vj, 0.0) / column["rsh"] * column["breakdown_part"] * (
        1 - np.minimum(vj, 0.0) / column["breakdown_V"]) ** -column["breakdown_m"]
    current = (column["photocurrent"] - column["i01"] * np.expm1(vj / (column["n1"] * vt))
               - column["i02"] * np.expm1(vj / (2 * vt)) - shunt - reverse)
    return vj - current * column["rs"], current


def series_voltages(voltages, currents, counts, grid):
    total = np.zeros_like(grid)
    for v, i, count in zip(voltages, currents, counts):
        total += count * np.interp(grid, i[::-1], v[::-1])
    return total


def group_curve(cells, temperature_C):
    """One group of cells in series: voltages (rising) and currents (falling)."""
    rows = np.stack([np.asarray(cells[name], float) for name in CELL_FIELDS], axis=1)
    distinct, counts = np.unique(rows, axis=0, return_counts=True)
    v, i = cell_curves({name: distinct[:, k] for k, name in enumerate(CELL_FIELDS)}, temperature_C)
    largest = np.max(distinct[:, 0])
    inside = (i > -0.3 * largest) & (i < 1.3 * largest)
    knots = [i[k][inside[k]][k % 3::max(1, min(len(distinct), 12))] for k in range(len(distinct))]
    edges = np.linspace(-0.3 * largest, 1.3 * largest, 400)
    grid = np.unique(np.concatenate(knots + [edges]))
    volts = series_voltages(v, i, counts, grid)
    return volts[::-1], grid[::-1]


def section_curve(groups, bypass, temperature_C):
    """Groups in parallel under one bypass diode: (saturation current, ideality), None if there is none (open)."""
    curves = [group_curve(group, temperature_C) for group in groups]
    knots = [v for v, _ in curves] + [np.linspace(-1.2, 0.0, 600)]
    low = max(v[0] for v, _ in curves)
    if bypass is not None:
        low = max(low, -1.2)
    high = min(v[-1] for v, _ in curves)
    volts = np.unique(np.concatenate(knots))
    volts = volts[(volts >= low) & (volts <= high)]
    current = sum(np.interp(volts, v, i) for v, i in curves)
    if bypass is not None:
        saturation, ideality = bypass
        current = current + saturation * np.expm1(np.minimum(-volts / (ideality * thermal_voltage(temperature_C)), 80))
    return volts, current


def string_curve(sections, temperature_C, resistance=0.0):
    """Sections in series and a resistance: voltages (rising) and currents. A section is (groups, bypass)."""
    known, curves = {}, []
    for groups, bypass in sections:
        key = (bypass, tuple(tuple(np.asarray(g[name], float).tobytes() for name in CELL_FIELDS) for g in groups))
        if key not in known:
            known[key] = len(curves)
            curves.append([section_curve(groups, bypass, temperature_C), 0])
        curves[known[key]][1] += 1
    step = max(1, len(curves) // 6)
    grid = np.unique(np.concatenate([curve[1][k % step::step] for k, (curve, _) in enumerate(curves)]))
    volts = np.zeros_like(grid)
    for (v, i), count in curves:
        falling = i[::-1]
        volts += count * np.interp(grid, falling, v[::-1])
    volts -= grid * resistance
    return volts[::-1], grid[::-1]


def current_at(curve, volts):
    return np.interp(volts, curve[0], curve[1])


def key_values(curve):
    """Isc, Voc, Imp, Vmp, by a parabola through the three highest powers for the last two."""
    v, i = curve
    isc = float(np.interp(0.0, v, i))
    voc = float(np.interp(0.0, -i, v))
    fine = np.linspace(0, voc, 4001)
    power = fine * np.interp(fine, v, i)
    k = int(min(max(np.argmax(power), 1), len(fine) - 2))
    left, middle, right = power[k - 1:k + 2]
    bend = left - 2 * middle + right
    shift = 0.5 * (left - right) / bend if bend < 0 else 0.0
    vmp = float(fine[k] + shift * (fine[1] - fine[0]))
    return {"isc_A": isc, "voc_V": voc, "imp_A": float(np.interp(vmp, v, i)), "vmp_V": vmp}
