"""Splits the power of a year of sweeps into four modes a week, as the Suns-Voc method does.

    four_modes.py SWEEPS.csv [--temperature 25] [--out FILE]

The method is that of Wang et al. 2018 (doi:10.1109/PVSC.2018.8547772) and of the public R package that its authors
made of it, written anew from its description. The pairs of short-circuit current and open-circuit voltage of a week,
carried to one temperature, are a curve without series resistance: the pseudo curve. Of its maximum power at
1000 W/m2, against that of the first 21 days,

- uniform current is what the change of the short-circuit current at 1000 W/m2 makes,
- recombination is what the change of the voltages of the pseudo curve makes,
- series resistance is what the fitted resistance takes: in full, not against that of the first days,
- current mismatch is what is left to the measured maximum power.

Gains are positive, W. There is no mode for the shunt, and no interval. Columns of the sweeps: date, irradiance_Wm2,
temperature_C, voltage_V, current_A (lists separated by blanks).
"""

import argparse
import csv
import datetime
import sys

import numpy as np

KELVIN = 273.15
FIRST_DAYS = 21
LEAST_WM2 = 100.0  # sweeps below are left out
BRIGHT = 0.7  # of the short-circuit current at 1000 W/m2: sweeps that stand for it
FEWEST = 12  # sweeps of a week
FIGURES = ("uniform_current_W", "recombination_W", "resistance_series_W", "mismatch_W", "isc_1sun_A",
           "resistance_series_ohm", "pseudo_p_mp_W", "p_mp_W")


def features(voltage, current):
    """Isc, Voc, slope -dV/dI at open circuit and maximum power of a sweep; None if it has no such shape."""
    order = np.argsort(voltage)
    v, i = voltage[order], current[order]
    if len(v) < 10 or not np.all(np.isfinite(v + i)) or i[0] <= 0:
        return None
    low = v < 0.25 * v[-1]
    if low.sum() < 3:
        return None
    isc = np.polyval(np.polyfit(v[low], i[low], 1), 0.0)
    end = i < 0.5 * isc
    if isc <= 0 or end.sum() < 4 or i[end].min() > 0.1 * isc:
        return None
    # A resistance and a logarithm follow the curve near open circuit.
    design = np.column_stack([np.ones(end.sum()), i[end], np.log1p(-i[end] / isc)])
    voc, line, log = np.linalg.lstsq(design, v[end], rcond=None)[0]
    slope = line - log / isc
    top = int(np.argmax(v * i))
    if voc <= 0 or slope >= 0 or top in (0, len(v) - 1):
        return None
    near = slice(max(0, top - 2), top + 3)
    a, b, c = np.polyfit(v[near], (v * i)[near], 2)
    power = c - b * b / (4 * a) if a < 0 else (v * i)[top]
    return isc, voc, -slope, power


def read_sweeps(path):
    """Features of the sweeps of a file as columns: day, light, temperature, isc, voc, slope, power, number of sweep."""
    rows, curves = [], []
    csv.field_size_limit(sys.maxsize)
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            voltage = np.array(row["voltage_V"].split(), dtype=float)
            current = np.array(row["current_A"].split(), dtype=float)
            light = float(row["irradiance_Wm2"] or "nan")
            if len(voltage) != len(current) or not light >= LEAST_WM2:
                continue
            found = features(voltage, current)
            if found is not None:
                day = datetime.date.fromisoformat(row["date"][:10]).toordinal()
                rows.append((day, light, float(row["temperature_C"]), *found, len(curves)))
                curves.append((voltage, current))
    sweeps = np.array(rows, dtype=float).reshape(-1, 8)
    ratio = sweeps[:, 3] / sweeps[:, 1]  # sweeps out of time with their sensor
    return sweeps[np.abs(ratio / np.median(ratio) - 1) < 0.25], curves


def robust_fit(design, values):
    """Least squares with Huber's weights at 1.5 of the median absolute residual in standard deviations."""
    weights = np.ones(len(values))
    for _ in range(20):
        root = np.sqrt(weights)
        fit = np.linalg.lstsq(design * root[:, None], values * root, rcond=None)[0]
        off = np.abs(values - design @ fit)
        bound = 1.5 * max(1.4826 * np.median(off), 1e-9)
        weights = np.minimum(1.0, bound / np.maximum(off, 1e-12))
    return fit


def voltage_at_zero_kelvin(sweeps):
    """E of Voc = E + T (a + b ln Isc), fitted to the first days. V."""
    kelvin = sweeps[:, 2] + KELVIN
    design = np.column_stack([np.ones_like(kelvin), kelvin, kelvin * np.log(sweeps[:, 3])])
    return robust_fit(design, sweeps[:, 4])[0]


class Pseudo:
    """The pseudo curve of a period: V = a + b ln Isc + c Isc over the currents that were seen."""

    def __init__(self, sweeps, zero_V, temperature):
        isc = sweeps[:, 3]
        voc = zero_V + (sweeps[:, 4] - zero_V) * (temperature + KELVIN) / (sweeps[:, 2] + KELVIN)
        self.isc_1sun = 1000 * robust_fit(sweeps[:, 1:2], isc)[0]
        self.fit = robust_fit(np.column_stack([np.ones_like(isc), np.log(isc), isc]), voc)
        self.least = isc.min()

    def voltage(self, isc):
        return self.fit[0] + self.fit[1] * np.log(isc) + self.fit[2] * isc

    def slope(self, isc):
        """-dV/dI at open circuit under that light, without resistance."""
        return self.fit[1] / isc + self.fit[2]

    def power(self, isc_1sun, ohm=0.0):
        isc = np.linspace(min(self.least, 0.03 * isc_1sun), isc_1sun, 4000)
        current = isc_1sun - isc
        return float(np.max(current * (self.voltage(isc) - current * ohm)))


def carried_power(voltage, current, amperes, volts, ohm):
    """Maximum power of a sweep that is moved along both axes, less the drop of the added current."""
    return float(np.max((voltage + volts - ohm * amperes) * (current + amperes)))


def modes_of(first, sweeps, curves, zero_V, temperature):
    pseudo = Pseudo(sweeps, zero_V, temperature)
    bright = sweeps[:, 3] > BRIGHT * pseudo.isc_1sun
    if bright.sum() < 3:
        return None
    isc, slope = sweeps[bright, 3], sweeps[bright, 5]
    ohm = float(np.median(slope - first.slope(isc)))
    at_sun = pseudo.voltage(pseudo.isc_1sun)
    powers = [carried_power(*curves[int(sweep[7])], pseudo.isc_1sun - sweep[3], at_sun - sweep[4], ohm)
              for sweep in sweeps[bright]]
    measured = float(np.median(powers))
    reference, moved = first.power(first.isc_1sun), first.power(pseudo.isc_1sun)
    ideal, resisted = pseudo.power(pseudo.isc_1sun), pseudo.power(pseudo.isc_1sun, ohm)
    return (moved - reference, ideal - moved, resisted - ideal, measured - resisted, pseudo.isc_1sun, ohm,
            reference, measured)


def weeks_of(sweeps, curves, temperature):
    """Weeks with their four modes; without them where a week has too few sweeps or too little light."""
    start = sweeps[:, 0].min()
    beginning = sweeps[sweeps[:, 0] < start + FIRST_DAYS]
    zero_V = voltage_at_zero_kelvin(beginning)
    first = Pseudo(beginning, zero_V, temperature)
    for day in np.arange(start, sweeps[:, 0].max() + 1, 7):
        own = sweeps[(sweeps[:, 0] >= day) & (sweeps[:, 0] < day + 7)]
        modes = modes_of(first, own, curves, zero_V, temperature) if len(own) >= FEWEST else None
        yield datetime.date.fromordinal(int(day)).isoformat(), len(own), modes


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("sweeps")
    parser.add_argument("--temperature", type=float, default=25.0, help="to which voltages are carried, C")
    parser.add_argument("--out", help="CSV file (standard output)")
    asked = parser.parse_args()
    sweeps, curves = read_sweeps(asked.sweeps)
    if len(sweeps) < 2 * FEWEST:
        parser.exit(1, f"{asked.sweeps}: {len(sweeps)} usable sweeps are too few\n")
    with open(asked.out, "w", encoding="utf-8") if asked.out else sys.stdout as file:
        file.write("week,sweeps," + ",".join(FIGURES) + "\n")
        for week, count, modes in weeks_of(sweeps, curves, asked.temperature):
            values = ["" if modes is None else f"{value:.4f}" for value in modes or [None] * len(FIGURES)]
            file.write(f"{week},{count}," + ",".join(values) + "\n")


if __name__ == "__main__":
    main()
