"""Made measurements, as texts: what chance chooses, and plain formulas of solar cells."""

import math
import random

K_Q = 1.380649e-23 / 1.602176634e-19  # V/K
BAND_GAP = 1.121  # eV


class Draw:
    """Chance that is the same always: of one name, in every version of Python."""

    def __init__(self, name):
        self._next = random.Random(name).random

    def between(self, low, high):
        return low + (high - low) * self._next()

    def log(self, low, high):
        """Between both, every decade alike."""
        return math.exp(self.between(math.log(low), math.log(high)))

    def whole(self, low, high):
        return low + int((high - low + 1) * self._next())

    def often(self, share):
        return self._next() < share

    def of(self, *items):
        return items[int(len(items) * self._next())]

    def some(self, items, count):
        """So many of them, in the order drawn."""
        left = list(items)
        return [left.pop(int(len(left) * self._next())) for _ in range(min(count, len(left)))]

    def weighed(self, **weights):
        place = sum(weights.values()) * self._next()
        for name, weight in weights.items():
            place -= weight
            if place < 0:
                return name
        return name

    def normal(self):
        return math.sqrt(-2 * math.log(1 - self._next())) * math.cos(2 * math.pi * self._next())


def thermal_V(celsius):
    return K_Q * (celsius + 273.15)


def device(draw, cells, current, voltage=(0.5, 0.72), n=(1.0, 1.8)):
    """Parameters of one diode so that `current` and the voltage of a cell at open circuit are those of a solar cell."""
    celsius, ideality, open_V = draw.between(10, 70), draw.between(*n), draw.between(*voltage)
    return {"cells": cells, "celsius": celsius, "Iph": current, "n": ideality,
            "Is": current / math.expm1(open_V / ideality / thermal_V(celsius)),
            "Rs": cells * open_V / current * draw.log(1e-3, 0.1), "Rsh": cells * open_V / current * draw.log(3, 3000)}


def junction_current(made, junction):
    """Current at the voltage of the junctions: diode, recombination with n = 2, shunt, and light that a weak field loses."""
    unit = made["cells"] * thermal_V(made["celsius"])
    lost = made["chi"] / (made["built_in"] - junction) if made.get("chi") else 0
    return (made["Iph"] * (1 - lost) - made["Is"] * math.expm1(junction / made["n"] / unit)
            - made.get("Is2", 0) * math.expm1(junction / 2 / unit) - junction / made["Rsh"])


def current_at(made, voltage):
    """Current at the terminals, by bisection of the junctions' voltage, which grows with that of the terminals."""
    low, high = voltage - 5, voltage + 5 + made["Iph"] * made["Rs"]
    high = min(high, made["cells"] * made["n"] * thermal_V(made["celsius"]) * 300)
    if made.get("chi"):
        high = min(high, made["built_in"] - 1e-6)
    for _ in range(60):
        middle = 0.5 * (low + high)
        if middle - junction_current(made, middle) * made["Rs"] < voltage:
            low = middle
        else:
            high = middle
    return junction_current(made, low)


def open_circuit_V(made):
    low, high = -1e-9, made["built_in"] - 1e-6 if made.get("chi") else made["cells"] * 3.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if junction_current(made, middle) > 0 else (low, middle)
    return low


def sweep(draw, made, voltages, noise_A):
    return [(voltage, current_at(made, voltage) + noise_A * draw.normal()) for voltage in voltages]


def steps(first, last, count):
    return [first + (last - first) * number / (count - 1) for number in range(count)]


def table(head, rows):
    lines = (",".join(value if isinstance(value, str) else f"{value:.8g}" for value in row) for row in rows)
    return "\n".join([head, *lines, ""])


def under(made, irradiance, celsius):
    """A device under other light and temperature, by the law of De Soto: `made` holds at 1000 W/m2 and 25 C."""
    kelvin, light = celsius + 273.15, irradiance / 1000
    gap = BAND_GAP * (1 - 0.0002677 * (celsius - 25))
    return {**made, "celsius": celsius, "Iph": light * made["Iph"] * (1 + made.get("alpha", 0.0005) * (celsius - 25)),
            "Is": made["Is"] * (kelvin / 298.15) ** 3 * math.exp((BAND_GAP / 298.15 - gap / kelvin) / K_Q),
            "Rsh": made["Rsh"] / light}


def key_points(made):
    """Isc, Voc, Imp and Vmp; the last by dividing an interval in thirds."""
    open_V = open_circuit_V(made)
    low, high = 0.5 * open_V, open_V
    for _ in range(45):
        first, second = low + (high - low) / 3, high - (high - low) / 3
        if first * current_at(made, first) < second * current_at(made, second):
            low = first
        else:
            high = second
    return current_at(made, 0), open_V, current_at(made, low), low


def module(draw):
    """A module at 1000 W/m2 and 25 C."""
    made = device(draw, draw.of(36, 60, 72, 96, 144), draw.log(2, 14), voltage=(0.58, 0.72), n=(1.0, 1.4))
    made["Rs"] = min(made["Rs"], 0.03 * made["cells"] * 0.6 / made["Iph"])
    made["Is"] = made["Iph"] / math.expm1(draw.between(0.6, 0.7) / made["n"] / thermal_V(25))
    return {**made, "celsius": 25.0, "alpha": draw.between(3e-4, 7e-4)}


def matrix(draw, made, noise):
    """Key points of a module over light and temperature, with relative errors."""
    rows = []
    for celsius in draw.of((25,), (25, 50), (15, 25, 50, 75)):
        for irradiance in draw.of((200, 500, 1000), (100, 200, 400, 600, 800, 1000), (200, 400, 600, 800, 1000, 1100)):
            points = key_points(under(made, irradiance, celsius))
            rows.append((celsius, irradiance, *(value * (1 + noise * draw.normal()) for value in points)))
    return table("temp_cell,effective_irradiance,i_sc,v_oc,i_mp,v_mp", rows)


def family(draw, made, noise):
    """Curves of a module under several lights and temperatures, in a long table; their number."""
    rows, count = [], draw.whole(3, 9)
    for curve in range(1, count + 1):
        irradiance, celsius = draw.between(150, 1050), draw.between(15, 65)
        now = under(made, irradiance, celsius)
        for voltage, current in sweep(draw, now, steps(0, 1.01 * open_circuit_V(now), draw.whole(12, 30)), noise * made["Iph"]):
            rows.append((str(curve), f"{irradiance:.1f}", f"{celsius:.2f}", voltage, current))
    return table("curve,irradiance_Wm2,temperature_C,voltage_V,current_A", rows), count


def laboratory_cell(draw):
    """Files of one laboratory cell by name: lit, lit and dark, several lights, both directions, a Suns-Voc trace, in one
    file or apart."""
    area = draw.of(0.06, 0.16, 0.25, 1, 4)
    made = device(draw, 1, area * draw.between(0.018, 0.042), voltage=(0.55, 1.15), n=(1.1, 1.9))
    made["celsius"] = 25.0
    made["Is"] = made["Iph"] / math.expm1(draw.between(0.55, 1.15) / made["n"] / thermal_V(25))
    if draw.often(0.4):
        made["Rsh"] = 1e9
    if draw.often(0.3):
        made["Is2"] = made["Iph"] * draw.log(0.02, 0.5) / math.expm1(open_circuit_V(made) / 2 / thermal_V(25))
    if draw.often(0.3):
        made["built_in"] = 1.2 * open_circuit_V(made)
        made["chi"] = made["built_in"] * draw.log(2e-3, 4e-2)
    noise = made["Iph"] * draw.log(3e-5, 3e-3)
    end, count = open_circuit_V(made), draw.whole(25, 60)
    up = steps(-0.1, (1.05 if made.get("chi") else 1.1) * end, count)
    kinds = draw.some(["lit", "dark", "lights", "pair", "suns"], draw.whole(1, 4))
    if not {"lit", "lights", "pair"} & set(kinds):
        kinds.insert(0, "lit")
    sweeps = []  # (kind, light, rows)
    if "lit" in kinds:
        sweeps.append(("lit", 1000, sweep(draw, made, up, noise)))
    if "dark" in kinds:
        sweeps.append(("dark", 0, sweep(draw, {**made, "Iph": 0.0}, up, noise / 10)))
    if "lights" in kinds:
        for light in draw.of((1000, 100), (1000, 300, 100), (1000, 300, 100, 30, 10)):
            sweeps.append(("lights", light, sweep(draw, {**made, "Iph": made["Iph"] * light / 1000}, up, noise * light / 1000)))
    if "pair" in kinds:
        other = {**made, "Iph": made["Iph"] * draw.between(0.96, 1), "n": made["n"] * draw.between(1, 1.02),
                 "Rs": made["Rs"] * draw.between(1, 1.6)}
        sweeps += [("pair", 1000, sweep(draw, made, up[::-1], noise)), ("pair", 1000, sweep(draw, other, up, noise))]
    apart, files = draw.often(0.5), {}
    for kind, light, rows in sweeps:
        files.setdefault(kind if apart else "cell", []).append((light, rows))
    given = []
    for name, parts in files.items():
        rows = [(voltage, current, str(number), str(light)) for number, (light, part) in enumerate(parts)
                for voltage, current in part]
        given.append((f"{name}.csv", table("voltage_V,current_A,sweep,irradiance_Wm2", rows)))
    if "suns" in kinds:
        lights = [10 ** power for power in steps(-2.3, 0.3, 25)]
        trace = [(light, open_circuit_V({**made, "Iph": made["Iph"] * light}) + 1e-5 * draw.normal()) for light in lights]
        given.append(("suns.csv", table("suns,Voc (V)", trace)))
    conditions = f'{{"cells_in_series": 1, "nominal_temperature_C": 25, "nominal_irradiance_Wm2": 1000, "area_cm2": {area}}}\n'
    sheets = [(name.replace(".csv", ".json"), conditions) for name, _ in given]
    return [name for name, _ in given], tuple(given + sheets)


def months(draw):
    """Sweeps of a module over months, a row each, and what befalls it: Rs or the shunt, light that is lost, a substring."""
    made, what = module(draw), draw.of("nothing", "Rs", "Rsh", "light", "substring", "slow")
    days, begin = draw.whole(90, 330), draw.between(0.3, 0.7)
    rows = []
    for day in range(0, days, draw.of(2, 3, 4)):
        for hour in (10, 12, 14):
            light = draw.between(250, 1000) * (1 if hour == 12 else 0.85)
            now = under(made, light, draw.between(5, 25) + 0.025 * light)
            since = day / days - begin
            if since > 0:
                now["Rs"] *= 1.6 if what == "Rs" else 1
                now["Rsh"] /= 8 if what == "Rsh" else 1
                now["Iph"] *= 0.92 if what == "light" else 1 - 0.1 * since if what == "slow" else 1
            part = 2 / 3 if what == "substring" and since > 0 else 1
            points = sweep(draw, now, steps(0, open_circuit_V(now), 13), 2e-4 * made["Iph"])
            month, of_month = divmod(day, 30)
            rows.append((f"2025-{month + 1:02}-{min(of_month + 1, 28):02} {hour}:00:00", f"{light * (1 + 0.002 * draw.normal()):.1f}",
                         f"{now['celsius'] + 0.2 * draw.normal():.2f}", str(made["cells"]), "3",
                         " ".join(f"{voltage * part:.3f}" for voltage, _ in points), " ".join(f"{current:.4f}" for _, current in points)))
    return table("date,irradiance_Wm2,temperature_C,cells_in_series,bypass_diodes,voltage_V,current_A", rows)


def law_of(made):
    """The law of a module as pvlib takes it."""
    return (f'{{"a_ref": {made["n"] * made["cells"] * thermal_V(25):.8g}, "I_L_ref": {made["Iph"]:.6g}, "I_o_ref": {made["Is"]:.6g}, '
            f'"R_s": {made["Rs"]:.6g}, "R_sh_ref": {made["Rsh"]:.6g}, "alpha_sc": {made["alpha"] * made["Iph"]:.6g}}}\n')
