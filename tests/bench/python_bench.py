"""The same measured curves by everything a Python user could fit a single diode with.

    PYTHONPATH=build/apps/python /usr/bin/python3 tests/bench/python_bench.py \
        --made build/tests/lyrefit_synthetic --command build/apps/lyrefit/lyrefit --json bench.json

Synthetic curves (noise, a quantiser, 50 readings each), one single diode each, solved-current residual,
lyrefit's physical box for all. Processor seconds on one pinned core; slow methods see the first
curves only, and say how many. A hit is an RMSE of that same objective, all recomputed by one
function, within 1e-9 (relative) of the best of all methods and of deep runs. With pvlib on
PYTHONPATH its fit_sandia_simple is timed as well: it minimises something else, which its RMSE shows.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ[variable] = "1"

import numpy as np
from scipy.optimize import curve_fit, differential_evolution, least_squares
from scipy.special import lambertw

import lyrefit
from lyrefit.pvlib import i_from_v

NAMES = ("photocurrent", "saturation_current", "n", "resistance_series", "resistance_shunt")
HIT = 1e-9


class Case:
    """One curve, the box all methods share, and n Ns Vt = n * volts."""

    def __init__(self, row):
        self.row = row
        self.v = np.array(row["voltage_V"])
        self.i = np.array(row["current_A"])
        self.volts = row["cells_in_series"] * 1.380649e-23 / 1.602176634e-19 * (
            row["temperature_C"] + 273.15)
        self.lower = self.upper = None

    def keywords(self):
        return {"cells_in_series": self.row["cells_in_series"],
                "temperature_C": self.row["temperature_C"],
                "irradiance_Wm2": self.row["irradiance_Wm2"]}

    def rmse(self, p):
        """Of the solved current at Iph, Is, n, Rs, Rsh."""
        current = i_from_v(self.v, p[0], p[1], p[3], p[4], p[2] * self.volts)
        return float(np.sqrt(np.mean((current - self.i) ** 2)))

    def guess(self):
        """The usual start: Isc, slopes at both ends, n = 1.3, Is from Voc."""
        order = np.argsort(self.v)
        v, i = self.v[order], self.i[order]
        conductance = max(-np.polyfit(v[:8], i[:8], 1)[0], 1e-6)
        ends = np.polyfit(i[-4:], v[-4:], 1)
        rs = max(-ends[0] - 1.3 * self.volts / i[0], 1e-4)
        isat = i[0] / np.expm1(max(ends[1], v[-1]) / (1.3 * self.volts))
        return np.array([i[0], isat, 1.3, rs, 1 / conductance])


def lambert_current(v, iph, isat, n, rs, rsh, volts):
    """I(V) in closed form (Jain and Kapoor 2004, doi:10.1016/j.solmat.2003.11.018)."""
    a = n * volts
    total = rs + rsh
    with np.errstate(over="ignore", invalid="ignore"):
        w = lambertw(isat * rs * rsh / (a * total) * np.exp(rsh * (v + rs * (iph + isat)) / (a * total)))
    return (rsh * (iph + isat) - v) / total - a / rs * w.real


def to_log(p):
    return np.array([p[0], np.log(p[1]), p[2], p[3], 1 / p[4]])


def from_log(x):
    return np.array([x[0], np.exp(x[1]), x[2], x[3], 1 / max(x[4], 1e-12)])


def log_box(case):
    """The box in (Iph, ln Is, n, Rs, 1 / Rsh); a saturation current of 0 is cut at 1e-20 A."""
    lower = np.array([case.lower[0], np.log(1e-20), case.lower[2], 1e-9, 1 / case.upper[4]])
    upper = np.array([case.upper[0], np.log(case.upper[1]), case.upper[2], case.upper[3],
                      1 / max(case.lower[4], 1e-3)])
    return lower, upper


def log_residual(x, case):
    return lambert_current(case.v, *from_log(x), case.volts) - case.i


def by_least_squares(case):
    lower, upper = log_box(case)
    return from_log(polished(np.clip(to_log(case.guess()), lower + 1e-9, upper - 1e-9), case))


def polished(start, case):
    return least_squares(log_residual, start, bounds=log_box(case), x_scale="jac", ftol=1e-15,
                         xtol=1e-15, gtol=1e-15, max_nfev=2000, args=(case,)).x


def by_curve_fit(case, **options):
    """As found in many scripts: parameters as they are, tolerances as they are."""
    lower = np.maximum(case.lower, [0, 1e-20, 0.1, 1e-9, 1e-3])
    upper = np.minimum(case.upper, 1e9)
    start = np.clip(case.guess(), lower * (1 + 1e-9), upper * (1 - 1e-9))
    model = lambda v, *p: lambert_current(v, *p, case.volts)  # noqa: E731
    return curve_fit(model, case.v, case.i, p0=start, bounds=(lower, upper), max_nfev=5000,
                     **options)[0]


def by_evolution(case, polish=False):
    lower, upper = log_box(case)

    def cost(x):
        value = np.mean(log_residual(x, case) ** 2)
        return value if np.isfinite(value) else 1e9

    best = differential_evolution(cost, list(zip(lower, upper)), seed=1, maxiter=1000)
    if not polish:
        return from_log(best.x)
    return from_log(polished(np.clip(best.x, lower + 1e-9, upper - 1e-9), case))


def by_evolution_and_polish(case):
    return by_evolution(case, polish=True)


def by_sandia_simple(case):
    from pvlib.ivtools.sde import fit_sandia_simple

    iph, isat, rs, rsh, a = fit_sandia_simple(case.v, case.i)
    return np.array([iph, isat, a / case.volts, rs, rsh])


def fit(case, **options):
    return lyrefit.fit(case.v, case.i, threads=1, **case.keywords(), **options)


def parameters(result):
    return np.array([result.parameters[name] for name in NAMES])


def by_many(cases, threads, **options):
    told = {name: np.array([case.row[name] for case in cases])
            for name in ("cells_in_series", "temperature_C", "irradiance_Wm2")}
    voltage, current = np.array([case.v for case in cases]), np.array([case.i for case in cases])
    frame = lyrefit.fit_many(voltage, current, threads=threads, **told, **options).frame()
    return frame[list(NAMES)].to_numpy()


def by_process(case, command, folder):
    path = os.path.join(folder, "curve.csv")
    with open(path, "w", encoding="ascii") as file:
        file.write("voltage,current\n")
        file.writelines(f"{v!r},{i!r}\n" for v, i in zip(case.v.tolist(), case.i.tolist()))
    out = subprocess.run([command, "fit", path, "--cells", str(case.row["cells_in_series"]),
                          "--temperature-C", str(case.row["temperature_C"]), "--threads", "1",
                          "--json", "-"], check=True, capture_output=True, text=True).stdout
    found = json.loads(out)["parameters"]
    return np.array([found[name]["refined"] for name in NAMES])


def processor_seconds():
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(one.ru_utime + one.ru_stime for one in used)


def each(method, cases):
    """Parameters of every case, NaN where the method raised, and processor seconds."""
    found = np.full((len(cases), 5), np.nan)
    began = processor_seconds()
    for k, case in enumerate(cases):
        try:
            found[k] = method(case)
        except (RuntimeError, ValueError):
            continue
    return found, processor_seconds() - began


def read_cases(options):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "made.jsonl")
        subprocess.run([options.made, "curves", "--out", path, "--count", str(options.curves),
                        "--points", "50", "--broken", "0", "--reversed", "0", "--seed", "1"],
                       check=True)
        with open(path, encoding="utf-8") as file:
            return [Case(json.loads(line)) for line in file]


def deep(cases):
    """The box of each case, and its best parameters from a far larger search."""
    found = []
    for case in cases:
        result = fit(case, population=100, iterations=300, seed=99, intervals="none")
        box = result["parameters"]
        largest = [1e9 if box[name]["upper"] is None else box[name]["upper"] for name in NAMES]
        case.lower = np.array([box[name]["lower"] for name in NAMES], dtype=float)
        case.upper = np.array(largest, dtype=float)
        found.append(parameters(result))
    return np.array(found)


def run(options):
    cases = read_cases(options)
    some, few = cases[:options.sample], cases[:options.slow]
    answers = {"deep runs": deep(some)}
    timed = {}

    def add(label, found, seconds, count, note=""):
        answers[label] = found
        timed[label] = {"curves": count, "seconds_a_curve": seconds / count, "note": note}
        print(f"{label}: {1e3 * seconds / count:.3f} ms a curve", file=sys.stderr, flush=True)

    def add_each(label, method, subset, note=""):
        each(method, subset[:1])  # imports and caches
        found, seconds = each(method, subset)
        add(label, found, seconds, len(subset), note)

    for label, keywords in (("lyrefit.fit_many", {}),
                            ("lyrefit.fit_many, no intervals", {"intervals": "none", "find_errors": False})):
        by_many(cases[:20], 1, **keywords)
        began = processor_seconds()
        found = by_many(cases, 1, **keywords)
        add(label, found[:len(some)], processor_seconds() - began, len(cases))
    os.sched_setaffinity(0, options.cores)
    began = time.perf_counter()
    by_many(cases, 0)
    wall = time.perf_counter() - began
    os.sched_setaffinity(0, {min(options.cores)})
    print(f"lyrefit.fit_many on {len(options.cores)} cores: {len(cases) / wall:.0f} curves a second of "
          f"wall clock, load {os.getloadavg()[0]:.1f}")
    add_each("lyrefit.fit, one call a curve", lambda case: parameters(fit(case)), some)
    add_each("lyrefit.fit, no intervals",
             lambda case: parameters(fit(case, intervals="none", find_errors=False)), some)
    with tempfile.TemporaryDirectory() as folder:
        add_each("lyrefit command, one process a curve",
                 lambda case: by_process(case, options.command, folder), some[:options.processes])
    add_each("SciPy least_squares, 1e-15, ln Is", by_least_squares, some)
    add_each("SciPy curve_fit, as it comes", by_curve_fit, some)
    add_each("SciPy curve_fit, x_scale='jac'", lambda case: by_curve_fit(case, x_scale="jac"), some)
    add_each("SciPy differential_evolution", by_evolution, few)
    add_each("SciPy the same, then least_squares", by_evolution_and_polish, few)
    try:
        add_each("pvlib fit_sandia_simple", by_sandia_simple, some, "minimises something else")
    except ImportError:
        print("pvlib is not importable: left out", file=sys.stderr)
    return judge(some, answers, timed)


def judge(cases, answers, timed):
    """Hits and RMSE of every method on the curves it saw."""
    rmse = {}
    for label, found in answers.items():
        rmse[label] = np.array([case.rmse(p) for case, p in zip(cases, found)])
    best = np.full(len(cases), np.inf)
    for label, values in rmse.items():
        inside = np.array([np.all(p <= case.upper * (1 + 1e-9)) and np.all(p >= case.lower)
                           for case, p in zip(cases, answers[label])])
        values = np.where(inside & np.isfinite(values), values, np.inf)
        best[:len(values)] = np.minimum(best[:len(values)], values)
    rows = []
    for label, row in timed.items():
        excess = rmse[label] / best[:len(rmse[label])] - 1
        rows.append({"method": label, **row, "judged": len(excess),
                     "per_second_and_core": 1 / row["seconds_a_curve"],
                     "hits": float(np.mean(excess <= HIT)),
                     "failed": float(np.mean(~np.isfinite(excess))),
                     "median_excess": float(np.nanmedian(excess)),
                     "largest_excess": float(np.nanmax(excess))})
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--made", required=True, help="the program lyrefit_synthetic")
    parser.add_argument("--command", required=True, help="the program lyrefit")
    parser.add_argument("--curves", type=int, default=10000)
    parser.add_argument("--sample", type=int, default=500, help="curves of the methods one by one")
    parser.add_argument("--processes", type=int, default=200, help="curves by one process each")
    parser.add_argument("--slow", type=int, default=20, help="curves of differential evolution")
    parser.add_argument("--json", help="file for the table")
    options = parser.parse_args()
    options.cores = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(options.cores)})
    load = os.getloadavg()[0]
    rows = run(options)
    print(f"single diode, solved current, {options.curves} curves of 50 readings, load {load:.1f} before")
    print(f"{'method':44s} {'curves':>7s} {'ms':>9s} {'1/s/core':>9s} {'hits':>7s} {'failed':>7s} "
          f"{'median excess':>14s} {'largest':>9s}")
    for row in rows:
        print(f"{row['method']:44s} {row['curves']:7d} {1e3 * row['seconds_a_curve']:9.3f} "
              f"{row['per_second_and_core']:9.1f} {100 * row['hits']:6.1f}% {100 * row['failed']:6.1f}% "
              f"{row['median_excess']:14.2g} {row['largest_excess']:9.2g}  {row['note']}")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({"load": load, "rows": rows}, file, indent=1)


if __name__ == "__main__":
    main()
