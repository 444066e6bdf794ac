# %% [markdown]
# A NOMAD entry of a cell, in place of a notebook that analyses its diode by hand: the files as the
# instruments wrote them, every figure with its interval, the archive with its units. See nomad.md.

# %%
import json
import os
import pathlib

import numpy as np

import lyrefit

data = pathlib.Path(os.environ.get("LYREFIT_ROOT", ".")) / "data"
THERMAL_V = 1.380649e-23 * 298.15 / 1.602176634e-19  # of the data below, at 25 C

# %% [markdown]
# ## The entry
# Sections and quantities are those of `JVMeasurement` (nomad-baseclasses) and of NOMAD's results. An
# archive holds numbers without units: each is in the unit of its quantity, mA/cm2 in the first, A/m2 in
# the second. Efficiency is in percent in both, the fill factor a fraction.

# %%
JV = "nomad_hysprint.schema_packages.hysprint_package.HySprint_JVmeasurement"


def jv_curve(sweep, area_cm2):
    """One sweep as a section of `jv_curve`; currents are positive where the cell delivers."""
    points = sweep["key_points"]
    section = {
        "cell_name": sweep["name"],
        "dark": sweep["kind"] == "dark",
        "voltage": sweep["data"]["voltage_V"],
        "current_density": [1e3 * i / area_cm2 for i in sweep["data"]["current_A"]],
    }
    if section["dark"]:
        return section
    section |= {
        "light_intensity": sweep["irradiance_Wm2"] / 10,
        "open_circuit_voltage": points["open_circuit_voltage_V"],
        "short_circuit_current_density": sweep["jsc_mA_cm2"],
        "fill_factor": points["fill_factor"],
        "efficiency": 100 * sweep["efficiency"],
        "potential_at_maximum_power_point": points["max_power_voltage_V"],
        "current_density_at_maximun_power_point": 1e3 * points["max_power_current_A"] / area_cm2,  # the schema's name
    }
    if sweep["fit"] and not sweep["void_because"]:  # a void fit has no resistances to store
        fitted = sweep["fit"]["parameters"]
        section["series_resistance"] = area_cm2 * fitted["resistance_series"]["refined"]
        section["shunt_resistance"] = area_cm2 * fitted["resistance_shunt"]["refined"]
    return section


def entry(record):
    """The archive of what `lyrefit.cell` found: `data`, and the best sweep in `results`."""
    # Without `data_file`: the plugin would read that file with its own parser, over these curves.
    area_cm2 = record["area_cm2"]
    sweeps = [sweep for sweep in record["sweeps"] if sweep["kind"] in ("lit", "dark")]
    curves = [jv_curve(sweep, area_cm2) for sweep in sweeps]
    best = max((curve for curve in curves if not curve["dark"]), key=lambda curve: curve["efficiency"])
    return {
        "data": {
            "m_def": JV,
            "name": record["name"],
            "description": f"{record['source']}, read by lyrefit {record['lyrefit_version']}",
            "active_area": area_cm2,
            "intensity": best["light_intensity"],
            "jv_curve": curves,
        },
        "results": {"properties": {"optoelectronic": {"solar_cell": {
            "open_circuit_voltage": best["open_circuit_voltage"],
            "short_circuit_current_density": 10 * best["short_circuit_current_density"],
            "fill_factor": best["fill_factor"],
            "efficiency": best["efficiency"],
            "illumination_intensity": 10 * best["light_intensity"],
            "device_area": 1e-4 * area_cm2,
        }}}},
    }


# %% [markdown]
# ## The diode
# Those schemas have no place for n, for several series resistances or for an interval. An archive may
# bring its own section: a quantity each, with its unit.

# %%


def diode_figures(record):
    """Name, unit, value and 95 % interval of what a diode analysis reports."""
    def row(name, unit, value, low=None, high=None):
        return {"name": name, "unit": unit, "value": value, "low_95": low, "high_95": high}

    figures = []
    for found in record["ideality_over_light"]:
        source = "suns_voc" if found["source"] == "Suns-Voc" else "voc_over_light"
        figures.append(row(f"n_{source}_brightest", "", found["local"][-1]["n"]))
    dark = record["ideality_dark"]
    if dark and dark["fitted"]:
        figures.append(row("n_dark_fit", "", *(dark["fitted"][key] for key in ("value", "low_95", "high_95"))))
    methods = {"lit against dark, equal Rs": "lit_dark", "Suns-Voc against lit": "suns_voc", "two lights": "two_lights",
               "single-diode fit, " + record["sweeps"][record["main"]]["name"]: "fit"}
    for found in record["resistance_series"]:
        name = next((own for start, own in methods.items() if found["method"].startswith(start)), None)
        if name and found["ohm"] is not None:
            methods = {start: own for start, own in methods.items() if own != name}  # two lights: the brightest
            figures.append(row(f"resistance_series_{name}", "ohm*cm**2", *(
                record["area_cm2"] * found[key] for key in ("ohm", "low_95_ohm", "high_95_ohm"))))
    joint = record["joint"]
    if joint and not joint["missing"] and not joint["void_because"]:
        n, rs = joint["parameters"]["n"], joint["parameters"]["resistance_series"]
        figures.append(row("n_joint", "", *(n[key] for key in ("refined", "low_95", "high_95"))))
        figures.append(row("resistance_series_joint", "ohm*cm**2", *(
            record["area_cm2"] * rs[key] for key in ("refined", "low_95", "high_95"))))
    if record["pseudo_fill_factor"]:
        figures.append(row("pseudo_fill_factor", "", record["pseudo_fill_factor"]["value"]))
    return figures


def diode_entry(record):
    """An archive that defines the section it fills."""
    quantities, values = {}, {}
    for figure in diode_figures(record):
        for key in ("value", "low_95", "high_95"):
            if figure[key] is None:
                continue
            name = figure["name"] + ("" if key == "value" else "_" + key)
            quantities[name] = {"type": "np.float64"} | ({"unit": figure["unit"]} if figure["unit"] else {})
            values[name] = figure[key]
    section = {"base_sections": ["nomad.datamodel.data.EntryData"], "quantities": quantities}
    return {
        "definitions": {"name": "lyrefit cell", "sections": {"DiodeAnalysis": section}},
        "data": {"m_def": "DiodeAnalysis", **values},
    }


# %% [markdown]
# ## What the notebook did by hand
# Slopes of straight lines through points that look straight, and readings interpolated.

# %%


def readings(record, kind, irradiance=None):
    """Voltages and currents of the first sweep of a kind."""
    found = next(sweep for sweep in record["sweeps"]
                 if sweep["kind"] == kind and irradiance in (None, sweep["irradiance_Wm2"]))
    return np.array(found["data"]["voltage_V"]), np.array(found["data"]["current_A"])


def by_hand(record, window_V, lights_A):
    """n of the dark curve between two voltages without its shunt, of Suns-Voc between two lights; Rs; pseudo-FF."""
    lit_v, lit_i = readings(record, "lit")
    dark_v, dark_i = readings(record, "dark")
    dark_i = -dark_i  # into the device
    isc, voc = np.interp(0, lit_v, lit_i), np.interp(0, -lit_i, lit_v)
    at = np.argmax(lit_v * lit_i)
    vmp, imp = lit_v[at], lit_i[at]
    suns = next(sweep for sweep in record["sweeps"] if sweep["kind"] == "Suns-Voc")
    suns_v = np.array(suns["data"]["voltage_V"])
    light = suns["suns_voc_A"] - np.array(suns["data"]["current_A"])
    shunt = np.abs(dark_v) <= 0.1
    leaked_i = np.polyfit(dark_v[shunt], dark_i[shunt], 1)[0] * dark_v
    straight = (dark_v >= window_V[0]) & (dark_v <= window_V[1])
    bright = (light >= lights_A[0]) & (light <= lights_A[1])
    pseudo = suns_v * (isc - light)
    area_cm2 = record["area_cm2"]
    return {
        "n_dark_fit": 1 / (THERMAL_V * np.polyfit(dark_v[straight], np.log((dark_i - leaked_i)[straight]), 1)[0]),
        "n_suns_voc_brightest": np.polyfit(np.log(light[bright]), suns_v[bright], 1)[0] / THERMAL_V,
        "resistance_series_lit_dark": area_cm2 * (np.interp(isc - imp, dark_i, dark_v) - vmp) / isc,
        "resistance_series_suns_voc": area_cm2 * (np.interp(isc - imp, light, suns_v) - vmp) / imp,
        "pseudo_fill_factor": np.max(pseudo) / (isc * voc),
    }


def rs_of_two_lights(record, bright_Wm2, dim_Wm2):
    """Rs (ohm cm2): both curves at equal Isc - I, from the power point of the brighter one."""
    (bright_v, bright_i), (dim_v, dim_i) = (readings(record, "lit", light) for light in (bright_Wm2, dim_Wm2))
    isc, dim_isc = np.interp(0, bright_v, bright_i), np.interp(0, dim_v, dim_i)
    at = np.argmax(bright_v * bright_i)
    equal_V = np.interp(-(dim_isc - isc + bright_i[at]), -dim_i, dim_v)
    return record["area_cm2"] * (equal_V - bright_v[at]) / (isc - dim_isc)


# %% [markdown]
# ## One cell: sweeps lit and dark, five lights, Suns-Voc

# %%
MADE_WITH = {"n_dark_fit": 1.4, "n_suns_voc_brightest": 1.4, "resistance_series_lit_dark": 1.5,
             "resistance_series_suns_voc": 1.5, "resistance_series_two_lights": 1.5, "resistance_series_fit": 1.5,
             "n_joint": 1.4, "resistance_series_joint": 1.5}
FIGURES = {"n_dark_fit": "n, dark curve", "n_suns_voc_brightest": "n, Suns-Voc", "pseudo_fill_factor": "pseudo-FF",
           "resistance_series_two_lights": "Rs, two lights (ohm cm2)",
           "resistance_series_lit_dark": "Rs, lit against dark (ohm cm2)",
           "resistance_series_suns_voc": "Rs, Suns-Voc (ohm cm2)", "resistance_series_fit": "Rs, fit (ohm cm2)",
           "n_joint": "n, all in one model", "resistance_series_joint": "Rs, all in one model (ohm cm2)"}


def compared(record, hand, made_with):
    """The table of the page: by hand, by lyrefit, the truth where the cell was made."""
    found = {figure["name"]: figure for figure in diode_figures(record)}
    lines = ["| figure | by hand | lyrefit | 95 % | made with |", "|---|---|---|---|---|"]
    for name, title in FIGURES.items():
        if name not in found:
            continue
        figure = found[name]
        interval = "" if figure["low_95"] is None else f"{figure['low_95']:#.4g} .. {figure['high_95']:#.4g}"
        cells = [title, f"{hand[name]:#.4g}" if name in hand else "", f"{figure['value']:#.4g}", interval,
                 str(made_with.get(name, ""))]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


cell = data / "cell"
record = lyrefit.cell([cell / name for name in ("lit_dark.csv", "suns.csv", "lights.csv")])
hand = by_hand(record, window_V=(0.7, 0.8), lights_A=(0.5e-3, 5.5e-3))
hand["resistance_series_two_lights"] = rs_of_two_lights(record, 1000, 300)
table = compared(record, hand, MADE_WITH)
print(table)
archive, analysis = entry(record), diode_entry(record)
pathlib.Path("cell.archive.json").write_text(json.dumps(archive, indent=1))
pathlib.Path("cell_diode.archive.json").write_text(json.dumps(analysis, indent=1))
print(json.dumps(archive["results"], indent=1))
