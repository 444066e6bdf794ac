#!/usr/bin/env python3
"""Computes every figure of `lyrefit cell` again, with NumPy and SciPy alone, and compares.

    python3 cell_reference.py LYREFIT [FILE...]
    python3 cell_reference.py --write FOLDER

Without files it makes measurements of a diode cell: up and down, five lights, lit and dark, a Suns-Voc trace; `--write`
leaves them in a folder (data/cell). Figures must agree within 1e-6; those of a fit are compared with a fit by SciPy, those
of a covariance within 1e-3, since that is computed here by differences. Of the joint model the optimum and what each
measurement adds are compared. Exit code 77: no SciPy.
"""
import json
import math
import os
import subprocess
import sys
import tempfile

try:
    import numpy as np
    from scipy.optimize import brentq, least_squares, minimize_scalar
    from scipy.special import lambertw
    from scipy.stats import t as student
except ImportError:
    sys.exit(77)

K_Q = 1.380649e-23 / 1.602176634e-19
FAILED = []
COUNT = 0


def same(name, found, expected, tolerance=1e-6, floor=1e-9):
    """Both unknown, or equal within a relative `tolerance` (absolute `floor`)."""
    global COUNT
    COUNT += 1
    found = math.nan if found is None else found
    expected = math.nan if expected is None else expected
    if math.isnan(found) and not math.isfinite(expected):
        return
    if not abs(found - expected) <= tolerance * abs(expected) + floor:
        FAILED.append(f"{name}: lyrefit {found}, here {expected}")


def diode_current(v, p, thermal):
    """Current of the single-diode model, by Lambert's W."""
    iph, i0, n, rs, rsh = p
    a = n * thermal
    v = np.asarray(v, float)
    if rs == 0:
        return iph - i0 * np.expm1(v / a) - v / rsh
    g = 1 / rsh
    exponent = (rs * (iph + i0) + v) / (a * (1 + rs * g))
    argument = rs * i0 / (a * (1 + rs * g)) * np.exp(exponent)
    return ((iph + i0) - v * g) / (1 + rs * g) - a / rs * lambertw(argument).real


def line(x, y):
    """Slope of the least-squares line and its standard error."""
    x, y = np.asarray(x), np.asarray(y)
    dx = x - x.mean()
    slope = (dx * (y - y.mean())).sum() / (dx * dx).sum()
    rest = y - y.mean() - slope * dx
    error = math.sqrt((rest * rest).sum() / (len(x) - 2) / (dx * dx).sum()) if len(x) > 2 else math.nan
    return slope, error


def crossing(x, y):
    """x at y = 0 of the line through the points, y falling."""
    for k in range(1, len(x)):
        if y[k - 1] > 0 >= y[k]:
            return x[k - 1] + (x[k] - x[k - 1]) * y[k - 1] / (y[k - 1] - y[k])
    return math.nan


def key_points(v, i):
    power = v * i
    k = int(np.argmax(power))
    c = np.polyfit(v[k - 1:k + 2] - v[k], power[k - 1:k + 2], 2)
    vmp = v[k] - c[1] / (2 * c[0])
    pmp = c[2] - c[1] ** 2 / (4 * c[0])
    isc, voc = float(np.interp(0, v, i)), crossing(v, i)
    return {"short_circuit_current_A": isc, "open_circuit_voltage_V": voc, "max_power_voltage_V": vmp,
            "max_power_current_A": pmp / vmp, "max_power_W": pmp, "fill_factor": pmp / (isc * voc)}


def best_reading(v, i):
    k = int(np.argmax(v * i))
    return v[k], i[k]


def near(values, reach):
    """The values nearest to 0, at least three, with neighbours up to `reach`."""
    order = np.argsort(np.abs(values), kind="stable")
    wanted = max(3, int((np.abs(values) <= reach).sum()))
    return np.sort(order[:wanted])


def check_sweep(sweep, area, thermal):
    v, i = np.array(sweep["data"]["voltage_V"]), np.array(sweep["data"]["current_A"])
    name = sweep["name"]
    if sweep["kind"] == "lit":
        key = key_points(v, i)
        for what, value in key.items():
            same(f"{name} {what}", sweep["key_points"][what], value)
        same(name + " Jsc", sweep["jsc_mA_cm2"], 1000 * key["short_circuit_current_A"] / area)
        same(name + " efficiency", sweep["efficiency"],
             key["max_power_W"] / (sweep["irradiance_Wm2"] * area * 1e-4))
        rows = near(v, key["open_circuit_voltage_V"] / 10)
        slope = line(v[rows], i[rows])[0]
        same(name + " R(Isc)", sweep["resistance_at_isc"]["ohm"], -1 / slope if slope < 0 else math.nan)
        rows = near(i, key["short_circuit_current_A"] / 10)
        same(name + " R(Voc)", sweep["resistance_at_voc"]["ohm"], -line(i[rows], v[rows])[0])
        same(name + " R(Voc) cm2", sweep["resistance_at_voc"]["ohm_cm2"], -line(i[rows], v[rows])[0] * area)
    if sweep["fit"] and not sweep["void_because"]:
        check_fit(sweep, v, i, thermal)


def parameters(sweep):
    return np.array([p["refined"] for p in sweep["fit"]["parameters"].values()])


def check_fit(sweep, v, i, thermal):
    """The fit against SciPy's, from its own end; parameters at bounds stay there."""
    estimates = list(sweep["fit"]["parameters"].values())
    p = parameters(sweep)
    free = [k for k, e in enumerate(estimates) if e["standard_error"] is not None]
    if not free:
        return
    unknown = 5 - sum(e["fixed"] for e in estimates)
    logs = [k in (1, 4) for k in range(5)]

    def full(x):
        q = p.copy()
        for k, value in zip(free, x):
            q[k] = math.exp(value) if logs[k] else value
        return q

    start = [math.log(p[k]) if logs[k] else p[k] for k in free]
    scale = np.abs(i).max()
    end = least_squares(lambda x: (diode_current(v, full(x), thermal) - i) / scale, start, x_scale="jac", xtol=1e-15,
                        ftol=1e-15, gtol=1e-15)
    q = full(end.x)
    for k in (0, 2, 3):
        if k in free:
            same(f"{sweep['name']} fit {estimates[k]['symbol']}", p[k], q[k], 1e-5, 1e-9)
    same(sweep["name"] + " fit RMSE", sweep["fit"]["rmse"]["solved_current_A"],
         math.sqrt(np.mean((diode_current(v, q, thermal) - i) ** 2)), 1e-6)
    if sweep["fit"]["under_errors"]:
        return
    # The covariance, by differences in the free parameters.
    columns = []
    for k in free:
        h = 1e-5 * p[k]
        up, down = p.copy(), p.copy()
        up[k] += h
        down[k] -= h
        columns.append((diode_current(v, up, thermal) - diode_current(v, down, thermal)) / (2 * h))
    jacobian = np.array(columns).T
    width = np.linalg.norm(jacobian, axis=0)
    unit = np.linalg.pinv((jacobian / width).T @ (jacobian / width), rcond=1e-14) / np.outer(width, width)
    rest = diode_current(v, p, thermal) - i
    covariance = unit * (rest @ rest) / (len(v) - unknown)
    for a, k in enumerate(free):
        for b, m in enumerate(free):
            size = math.sqrt(covariance[a, a] * covariance[b, b])
            same(f"{sweep['name']} covariance {k}{m}", sweep["fit"]["covariance"][k][m] / size, covariance[a, b] / size,
                 1e-3, 1e-3)


def check_pair(pair, sweeps):
    f, r = sweeps[pair["forward"]], sweeps[pair["reverse"]]
    vf, jf = (np.array(f["data"][k]) for k in ("voltage_V", "current_A"))
    vr, jr = (np.array(r["data"][k]) for k in ("voltage_V", "current_A"))
    kf, kr = key_points(vf, jf), key_points(vr, jr)
    voc, isc = kr["open_circuit_voltage_V"], kr["short_circuit_current_A"]
    at = lambda v: (np.interp(v, vf, jf), np.interp(v, vr, jr))

    def area(v, j, end):
        grid = np.concatenate(([0], v[(v > 0) & (v < end)], [end]))
        return np.trapz(np.interp(grid, v, j), grid)

    same("index power", pair["index_power"], 1 - kf["max_power_W"] / kr["max_power_W"])
    same("index area", pair["index_area"], 1 - area(vf, jf, kf["open_circuit_voltage_V"]) / area(vr, jr, voc))
    for part, key in ((0.8, "index_at_80"), (0.5, "index_at_50")):
        up, down = at(part * voc)
        same(key, pair[key], (down - up) / down)
    up, down = at(np.linspace(0, max(voc, kf["open_circuit_voltage_V"]), 1001))
    same("gap", pair["gap_percent"], 100 * math.sqrt(np.mean((down - up) ** 2)) / isc)
    same("dVoc", pair["voc_difference_V"], voc - kf["open_circuit_voltage_V"])
    same("dIsc", pair["isc_difference"], 1 - kf["short_circuit_current_A"] / isc)
    same("dFF", pair["ff_difference"], kr["fill_factor"] - kf["fill_factor"])


def voc_at(points, light):
    x = np.log([p["light_A"] for p in points])
    y = [p["voc_V"] for p in points]
    return float(np.interp(math.log(light), x, y, math.nan, math.nan)) if light > 0 else math.nan


def check_junction(over, light, voc, thermal, isc):
    """n beside a shunt by least squares of the voltages that solve light = exp((V - c) / a) + g V."""
    rows = (light >= isc / 30) & (light <= 3 * isc)
    light, voc = light[rows], voc[rows]

    def off(p):
        a, c, g = p[0] * thermal, p[1], abs(p[2]) * isc
        return [brentq(lambda v: math.exp((v - c) / a) + g * v - l, -5, 5) - v for l, v in zip(light, voc)]

    start = line(np.log(light), voc)[0]
    p = least_squares(off, [start / thermal, voc[-1] - start * math.log(light[-1]), 1e-3], x_scale=[1, 0.1, 1e-2],
                      xtol=1e-12, ftol=1e-12).x
    same("n of the junction", over["junction"]["value"], p[0], 2e-3)


def check_over_light(over, sweeps, thermal, main_isc):
    if over["source"] == "lit":
        lit = [s for s in sweeps if s["kind"] == "lit"]
        lights = {s["irradiance_Wm2"] for s in lit}
        series = [[s for s in lit if (s["file"], s["direction"]) == (one["file"], one["direction"])] for one in lit]
        by_light = {}
        for s in next((one for one in series if {s["irradiance_Wm2"] for s in one} == lights), lit):
            if s["kind"] == "lit":
                by_light.setdefault(s["irradiance_Wm2"], []).append(
                    key_points(np.array(s["data"]["voltage_V"]), np.array(s["data"]["current_A"])))
        points = sorted((np.mean([k["short_circuit_current_A"] for k in keys]),
                         np.mean([k["open_circuit_voltage_V"] for k in keys])) for keys in by_light.values())
    else:
        trace = next(s for s in sweeps if s["kind"] == "Suns-Voc")
        points = sorted((trace["suns_voc_A"] - i, v) for v, i in zip(trace["data"]["voltage_V"],
                                                                     trace["data"]["current_A"])
                        if trace["suns_voc_A"] - i > 0 and v > 0)
    same("points", len(over["points"]), len(points))
    light, voc = np.array(points).T
    slope, error = line(np.log(light), voc)
    same("n over light", over["n"]["value"], slope / thermal)
    if len(points) > 2:
        reach = student.ppf(0.975, len(points) - 2) * error / thermal
        same("n over light, low", over["n"]["low_95"], slope / thermal - reach)
        same("n over light, high", over["n"]["high_95"], slope / thermal + reach)
    for k, one in enumerate(over["local"]):
        ends = np.interp(np.log([one["low_A"], one["high_A"]]), np.log(light), voc)
        same(f"local n {k}", one["n"], (ends[1] - ends[0]) / math.log(one["high_A"] / one["low_A"]) / thermal)
    if len(points) >= 12:
        check_junction(over, light, voc, thermal, main_isc)


def check_dark(dark, sweeps, thermal):
    sweep = sweeps[dark["sweep"]]
    v, i = np.array(sweep["data"]["voltage_V"]), -np.array(sweep["data"]["current_A"])
    rows = near(v, 0.025)
    shunt = max(0, line(v[rows], i[rows])[0])
    diode = i - shunt * v
    keep = (v > 0) & (diode > 10 * sweep["noise_A"]) & (diode > i / 2)
    v, log = v[keep], np.log(diode[keep])
    local = []
    for k in range(len(v) - 4):
        last = k + 5
        while last < len(v) and v[last] - v[k] <= 0.05:
            last += 1
        local.append((1 / line(v[k:last], log[k:last])[0] / thermal, v[k:last].mean()))
    least = min(local)
    same("dark n", dark["least_n"], least[0])
    same("dark n at", dark["at_V"], least[1])


def check_resistances(report, thermal):
    sweeps = report["sweeps"]
    main = sweeps[report["main"]]
    curve = lambda s: (np.array(s["data"]["voltage_V"]), np.array(s["data"]["current_A"]))
    isc = key_points(*curve(main))["short_circuit_current_A"]
    vmp, imp = best_reading(*curve(main))
    lights = {}
    for s in sweeps:
        if s["kind"] == "lit" and s["direction"] == main["direction"]:
            lights.setdefault(s["irradiance_Wm2"], s)
    lights = [lights[g] for g in sorted(lights, reverse=True)]
    pairs = iter(zip(lights, lights[1:]))
    dark = sweeps[report["ideality_dark"]["sweep"]] if report["ideality_dark"] else None
    for one in report["resistance_series"]:
        if one["missing"]:
            continue
        if one["method"].startswith("two lights"):
            bright, dim = next(pairs)
            kb, kd = key_points(*curve(bright)), key_points(*curve(dim))
            v, i = curve(dim)
            i1, i2 = kb["short_circuit_current_A"], kd["short_circuit_current_A"]
            v1, at = best_reading(*curve(bright))
            rows = (i2 - i > 0) & (v > 0)
            v2 = np.interp(math.log(i1 - at), np.log(i2 - i[rows]), v[rows])
            expected = (v2 - v1) / (i1 - i2)
        elif one["method"].startswith("lit against dark"):
            v, i = curve(dark)
            rising = -i > 0
            vd = np.interp(math.log(isc - imp), np.log(-i[rising]), v[rising])
            rs = parameters(dark)[3]
            own = "dark fit" in one["method"]
            expected = (vd - vmp - (isc - imp) * rs) / imp if own else (vd - vmp) / isc
        elif "against lit" in one["method"]:
            source = "Suns-Voc" if one["method"].startswith("Suns") else "lit"
            over = next(o for o in report["ideality_over_light"] if o["source"] == source)
            expected = (voc_at(over["points"], isc - imp) - vmp) / imp
        elif one["method"].startswith("slope"):
            v, i = curve(main)
            rows = near(i, isc / 10)
            expected = -line(i[rows], v[rows])[0]
        else:
            continue
        same("Rs, " + one["method"], one["ohm"], expected)
        same("Rs cm2, " + one["method"], one["ohm_cm2"], expected * report["area_cm2"])


def ideal_fill_factor(isc, voc, a):
    power = lambda v: -v * (isc - isc * math.expm1(v / a) / math.expm1(voc / a))
    return -minimize_scalar(power, bounds=(0, voc), method="bounded", options={"xatol": 1e-12}).fun / (isc * voc)


def check_pseudo(report, thermal):
    pseudo, main = report["pseudo_fill_factor"], report["sweeps"][report["main"]]
    key = key_points(np.array(main["data"]["voltage_V"]), np.array(main["data"]["current_A"]))
    isc, voc = key["short_circuit_current_A"], key["open_circuit_voltage_V"]
    same("ideal FF", pseudo["ideal"], ideal_fill_factor(isc, voc, thermal))
    source = {"Suns-Voc": "Suns-Voc", "Voc of the light series": "lit"}.get(pseudo["source"])
    if source is None:
        return
    points = next(o for o in report["ideality_over_light"] if o["source"] == source)["points"]
    voltages = np.array([p["voc_V"] for p in points])
    logs = np.log([p["light_A"] for p in points])
    end = voc_at(points, isc)
    power = lambda v: -v * (isc - math.exp(np.interp(v, voltages, logs)))
    best = 0
    for low, high in zip(voltages, np.minimum(voltages[1:], end)):
        if low < high:
            best = max(best, -minimize_scalar(power, bounds=(low, high), method="bounded",
                                              options={"xatol": 1e-13}).fun)
    same("pseudo FF", pseudo["value"], best / (isc * end))


def loss_parts(p, thermal):
    """Losses by recombination, shunt, series resistance and the fitted FF, by root finding and maximisation."""
    iph, i0, n, rs, rsh = p
    a = n * thermal
    voc = brentq(lambda v: iph - i0 * math.expm1(v / a) - v / rsh, 0, a * math.log1p(iph / i0), xtol=1e-15)
    isc = brentq(lambda i: iph - i0 * math.expm1(i * rs / a) - i * rs / rsh - i, 0, iph * 1.1, xtol=1e-18, rtol=1e-15)

    def ff(n_, g, r):
        b = n_ * thermal
        # Photocurrent and saturation current that keep the ends.
        matrix = [[1, -math.expm1(isc * r / b)], [1, -math.expm1(voc / b)]]
        photo, sat = np.linalg.solve(matrix, [isc + isc * r * g, voc * g])
        current = lambda u: photo - sat * math.expm1(u / b) - u * g
        power = lambda u: -(u - current(u) * r) * current(u)
        return -minimize_scalar(power, bounds=(isc * r, voc), method="bounded",
                                options={"xatol": 1e-12}).fun / (isc * voc)

    steps = [ff(1, 0, 0), ff(n, 0, 0), ff(n, 1 / rsh, 0), ff(n, 1 / rsh, rs)]
    return np.array([steps[0] - steps[1], steps[1] - steps[2], steps[2] - steps[3], steps[3]]), steps


def check_losses(losses, sweeps, thermal):
    if losses["missing"]:
        return
    sweep = sweeps[losses["sweep"]]
    p = parameters(sweep)
    own, steps = loss_parts(p, thermal)
    for k, name in enumerate(("ideal", "without_resistances", "without_series", "fitted")):
        same("losses " + name, losses[name], steps[k])
    found = [part["loss"] for part in losses["parts"]]
    for k in range(3):
        same(f"loss {k}", found[k]["value"], own[k], 1e-6, 1e-8)
    same("sum of losses", losses["ideal"] - sum(f["value"] for f in found), losses["measured"], 1e-12, 1e-12)
    covariance = np.array([[math.nan if c is None else c for c in row] for row in sweep["fit"]["covariance"]])
    if any(e["at_bound"] for e in sweep["fit"]["parameters"].values()):
        return
    gradient = []
    for k in range(5):
        h = min(1e-2 * math.sqrt(covariance[k, k]), 1e-3 * p[k])
        up, down = p.copy(), p.copy()
        up[k] += h
        down[k] -= h
        gradient.append((loss_parts(up, thermal)[0] - loss_parts(down, thermal)[0]) / (2 * h))
    gradient = np.array(gradient)
    reach = sweep["fit"]["t_95"] * np.sqrt(np.einsum("ik,ij,jk->k", gradient, covariance, gradient))
    for k in range(4):
        same(f"loss {k} high", found[k]["high_95"] - found[k]["value"], reach[k], 2e-3, 1e-7)
    v = lambda n: losses_voc / (n * thermal)
    losses_voc = brentq(lambda u: p[0] - p[1] * math.expm1(u / (p[2] * thermal)) - u / p[4], 0, 10)
    green = lambda x: (x - math.log(x + 0.72)) / (x + 1)
    same("Green n = 1", losses["green_n1"], green(v(1)))
    same("Green", losses["green_fitted"], green(v(p[2])))


def check_superposition(found, sweeps):
    if found is None or found["rms_percent"] is None:
        return
    lit, dark = sweeps[found["lit"]], sweeps[found["dark"]]
    v, i = (np.array(lit["data"][k]) for k in ("voltage_V", "current_A"))
    key = key_points(v, i)
    isc, voc = key["short_circuit_current_A"], key["open_circuit_voltage_V"]
    vd, jd = (np.array(dark["data"][k]) for k in ("voltage_V", "current_A"))
    x, y = vd + jd * found["dark_rs_ohm"], -jd
    rows = (v >= 0) & (v <= voc)
    junction, lost, current = v[rows] + i[rows] * found["lit_rs_ohm"], isc - i[rows], []
    for u in junction:
        k = int(np.searchsorted(x, u, side="right"))
        if k == 0 or k == len(x):
            current.append(math.nan)
            continue
        part = (u - x[k - 1]) / (x[k] - x[k - 1])
        both = y[k - 1] > 0 and y[k] > 0
        current.append(y[k - 1] * (y[k] / y[k - 1]) ** part if both else y[k - 1] + part * (y[k] - y[k - 1]))
    current = np.array(current)
    known = np.isfinite(current)
    lost, current = lost[known], current[known]
    off = current - lost
    rms = lambda x: 100 * math.sqrt(np.mean(x * x)) / isc
    same("superposition rms", found["rms_percent"], rms(off))
    same("superposition largest", found["largest_percent"], 100 * off[np.argmax(np.abs(off))] / isc)
    scale = (lost @ current) / (current @ current)
    same("dark scale", found["dark_scale"], scale)
    same("scaled rms", found["scaled_rms_percent"], rms(lost - scale * current))
    if y.max() > isc:
        rows = y > 0
        same("Voc shift", found["voc_shift_V"], voc - np.interp(math.log(isc), np.log(y[rows]), x[rows]), 1e-6, 1e-8)


def check_joint(joint, sweeps, thermal):
    """The joint optimum: residuals, a Gauss-Newton step, and what each measurement adds."""
    kinds = {sweeps[one["sweep"]]["kind"] for one in joint["measurements"]}
    if joint["missing"] or joint["second_diode"] or "Suns-Voc" in kinds:
        return
    estimates = joint["parameters"]
    at = {name: e["refined"] for name, e in estimates.items()}
    free = [name for name, e in estimates.items() if not e["fixed"]]
    readings = sum(one["readings"] for one in joint["measurements"])
    spread = math.sqrt(readings / (readings - len(free)))
    errors = [one["rms"] * spread for one in joint["measurements"]]

    def residuals(p, k):
        sweep = sweeps[joint["measurements"][k]["sweep"]]
        iph = p.get("photocurrent[" + sweep["name"] + "]", 0)
        shunt = 1 / (1 / p["resistance_shunt"] + p["collection_slope"] * iph)
        diode = [iph, p["saturation_current"], p["n"], p["resistance_series"], shunt]
        v, i = np.array(sweep["data"]["voltage_V"]), np.array(sweep["data"]["current_A"])
        return diode_current(v, diode, thermal) - i

    jacobians = []
    for k, one in enumerate(joint["measurements"]):
        rest = residuals(at, k)
        same("joint rms", one["rms"], math.sqrt(np.mean(rest * rest)), 1e-6, 1e-15)
        columns = []
        for name in free:
            step = 1e-5 * at[name] or 1e-7
            sides = [residuals({**at, name: at[name] + d}, k) for d in (step, -step)]
            columns.append((sides[0] - sides[1]) / (2 * step) / errors[k])
        jacobians.append(np.array(columns).T)

    def standard_errors(some):
        stacked = np.vstack(some)
        scale = np.linalg.norm(stacked, axis=0)
        scale[scale == 0] = 1
        _, sizes, v = np.linalg.svd(stacked / scale)
        if len(sizes) < len(free) or sizes[-1] < 1e-9 * sizes[0]:
            return None
        # Differences do not make a Jacobian exactly singular: what is smaller than their own error
        # determines no parameter that has a part in it.
        told = sizes > 1e-6 * sizes[0]
        variance = ((v[told].T / sizes[told]) ** 2).sum(axis=1)
        untold = (np.abs(v[~told]) > 1e-4).any(axis=0)
        return np.where(untold, math.inf, np.sqrt(variance) / scale)

    own = standard_errors(jacobians)
    inside = [k for k, name in enumerate(free) if not estimates[name]["at_bound"]]
    stacked = np.vstack(jacobians)[:, inside]
    step = np.linalg.lstsq(stacked * own[inside], np.concatenate([r / e for r, e in zip(
        [residuals(at, k) for k in range(len(errors))], errors)]), rcond=None)[0]
    same("joint optimum: a further step in standard errors", float(np.abs(step).max()), 0, 0, 0.03)
    for k, one in enumerate(joint["measurements"]):
        others = standard_errors([j for i, j in enumerate(jacobians) if i != k])
        for name, ratio in one["standard_error_without"].items():
            if others is None:
                continue
            expected = others[free.index(name)] / own[free.index(name)]
            same("standard error without", ratio, expected if expected < 1e5 else math.inf, 1e-2)


def check(report):
    if report["area_cm2"] is None:
        report["area_cm2"] = math.nan
    thermal = report["cells_in_series"] * K_Q * (report["temperature_C"] + 273.15)
    sweeps = report["sweeps"]
    for sweep in sweeps:
        check_sweep(sweep, report["area_cm2"], thermal)
    for pair in report["hysteresis"]:
        check_pair(pair, sweeps)
    for over in report["ideality_over_light"]:
        check_over_light(over, sweeps, thermal,
                         sweeps[report["main"]]["key_points"]["short_circuit_current_A"])
    if report["ideality_dark"]:
        check_dark(report["ideality_dark"], sweeps, thermal)
    check_resistances(report, thermal)
    check_pseudo(report, thermal)
    for losses in report["fill_factor_losses"]:
        check_losses(losses, sweeps, thermal)
    check_superposition(report["superposition"], sweeps)
    if report["joint"]:
        check_joint(report["joint"], sweeps, thermal)


def make_files(folder):
    """Measurements of one cell of 0.25 cm2 with white noise."""
    thermal = K_Q * 298.15
    random = np.random.default_rng(7)
    cell = [5.5e-3, 2e-13, 1.4, 6.0, 9000.0]

    def write(name, header, rows):
        path = os.path.join(folder, name + ".csv")
        with open(path, "w") as out:
            out.write(header + "\n" + "".join(",".join(f"{x:.9g}" for x in row) + "\n" for row in rows))
        with open(path[:-4] + ".json", "w") as out:
            json.dump({"cells_in_series": 1, "nominal_temperature_C": 25, "nominal_irradiance_Wm2": 1000,
                       "area_cm2": 0.25}, out)
        return path

    def sweep(p, voltages, number, light):
        current = diode_current(voltages, p, thermal) + 1e-6 * random.standard_normal(len(voltages))
        return [(v, i, number, light) for v, i in zip(voltages, current)]

    up = np.arange(-0.1, 0.961, 0.01)
    head = "voltage_V,current_A,sweep,irradiance_Wm2"
    worse = [5.45e-3, 2e-13, 1.42, 9.0, 6000.0]
    pair = write("pair", "voltage_V,current_A,sweep",
                 [row[:3] for row in sweep(cell, up[::-1], 1, 0) + sweep(worse, up, 2, 0)])
    rows = []
    for k, light in enumerate((1000, 300, 100, 30, 10)):
        rows += sweep([cell[0] * light / 1000] + cell[1:], up, k, light)
    lights = write("lights", head, rows)
    both = write("lit_dark", head, sweep(cell, up, 0, 1000) + sweep([0] + cell[1:], up, 1, 0))
    suns = 10 ** np.arange(-2.5, 0.31, 0.1)
    voc = [brentq(lambda v: diode_current(v, [cell[0] * s] + cell[1:], thermal), 0, 1.5) for s in suns]
    trace = write("suns", "suns,Voc (V)", list(zip(suns, voc)))
    coarse = np.arange(-0.1, 0.961, 0.02)
    noise = lambda: 1e-6 * random.standard_normal(len(coarse))  # noqa: E731
    pixels = {"a_Forward_Light": diode_current(coarse, worse, thermal) + noise(),
              "a_Reverse_Light": diode_current(coarse, cell, thermal) + noise(),
              "a_Forward_Dark": diode_current(coarse, [0] + cell[1:], thermal) + noise(),
              "b_Forward_Light": diode_current(coarse, [5.2e-3] + worse[1:], thermal) + noise(),
              "b_Reverse_Light": diode_current(coarse, [5.2e-3] + cell[1:], thermal) + noise(),
              "c_Forward_Light": 1e-3 - coarse / 20, "c_Reverse_Light": 1e-3 - coarse / 20,
              "d_Forward_Light": 1e-9 * noise(), "d_Reverse_Light": 1e-9 * noise()}
    write("substrate", ",".join(["voltage (V)", *("Current (A)_" + name for name in pixels)]),
          list(zip(coarse, *pixels.values())))
    return [[pair], [lights], [both], [both, trace], [pair, trace, both], [pair, lights]]


def main():
    if sys.argv[1] == "--write":
        make_files(sys.argv[2])
        return
    app, files = sys.argv[1], sys.argv[2:]
    with tempfile.TemporaryDirectory() as folder:
        for measurement in [[f] for f in files] or make_files(folder):
            out = os.path.join(folder, "out.json")
            subprocess.run([app, "cell", *measurement, "--json", out, "--quiet"], check=True)
            check(json.load(open(out)))
    print(f"{COUNT} figures compared, {len(FAILED)} differ")
    print("\n".join(FAILED))
    sys.exit(1 if FAILED or COUNT < 100 and not files else 0)


main()
