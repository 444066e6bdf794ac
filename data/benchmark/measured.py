"""The measured curves of the benchmark: which of a folder of labelled sweeps go in, under which licence, as what.

The folder is that of the CMake option LYREFIT_FIELD_DATA: `field/single` and `lab`, each with a `labels.csv`. Only curves
whose source states a licence that allows to pass them on, and whose label is clean or fault, are taken; LEFT_OUT says
what else is there and why not.
"""

import csv
import hashlib
import json

# The beginning of a source's name in labels.csv: its licence, who holds the copyright, what it is.
SOURCES = {
    "DuraMAT/pvpro": ("BSD-3-Clause", "2020 DuraMAT", "60-cell module on NIST's ground array"),
    "pvlib/MATLAB_PV_LIB": ("BSD-3-Clause", "2013 Sandia National Laboratories, 2014 PVLIB python Developers, 2015 pvlib "
                            "python Contributors", "36-cell module of Sandia, as pvlib-python carries it"),
    "SunsVoc": ("BSD-3-Clause", "2018-2020 Menghong Wang, Jiqi Liu, Tyler Burleyson, Roger H. French, Jennifer L Braid; "
                "Case Western Reserve University", "60-cell module outdoors, clear days and snow"),
    "NREL/PVcircuit": ("BSD-3-Clause", "2022 Alliance for Sustainable Energy, LLC", "cells of NREL and ISFH"),
    "i-MEET/boar": ("BSD-3-Clause", "2023 Vincent M. Le Corre, Larry Lüer", "an organic cell, lit and dark"),
    "nomad-hysprint": ("Apache-2.0", "Helmholtz-Zentrum Berlin", "perovskite pixels, both directions"),
    "nomad-hzb/nomad-hysprint": ("Apache-2.0", "Helmholtz-Zentrum Berlin", "perovskite pixels, both directions, dark"),
    "nomad-hzb/nomad-perotf": ("Apache-2.0", "Karlsruhe Institute of Technology, Helmholtz-Zentrum Berlin",
                               "a perovskite pixel, both directions"),
    "nomad-hzb/nomad-tfsc-general": ("MIT", "2025 Michael Götte", "perovskite pixels, both directions"),
}
LEFT_OUT = {
    "pvcracks": "its README says MIT, its licence file BSD-3-Clause and of other code, and the curves are the Technical "
                "University of Denmark's: none of them says under what they may be passed on",
    "cran/ddiv": "GPL-2 or later: may be passed on, but whoever merges these curves into a data set would be bound by it",
    "showcase": "two of its curves are cran/ddiv's; of the third the logged irradiance is wrong for an unknown reason, and "
                "whether that is a fault of the sensor nobody can say",
    "griddler-j/PV_circuit_model": "MIT, but the readings look computed, not measured",
    "akinomy/iv.opv.package": "MIT, but nobody knows what is right to say of these pixels",
}
# Names of lyrefit's catalogue, in which the labels are written, and the benchmark's causes.
CAUSE_OF = {
    "shading": "shade", "substrings": "shade", "covered_edge": "shade", "weak_cell": "shade", "dim_cells": "shade",
    "mismatch": "mismatch", "scatter": "mismatch", "leaky_cell": "shunt", "graded_shunt": "shunt",
    "nonohmic_shunt": "shunt", "breakdown": "shunt", "bypass_open": "bypass_open", "bypass_short": "bypass_short",
    "open_substring": "bypass_short", "second_diode": "cell", "collection": "cell", "photoshunt": "cell",
    "back_contact": "cell", "rs_current": "cell", "distributed_rs": "cell", "aged_contacts": "cell", "superposition": "cell",
    "series_resistance": "series_resistance",
    "drift": "light", "irr_step": "light", "transient": "light", "temp_drift": "light",
    "hysteresis": "hysteresis", "ionic_hysteresis": "hysteresis", "ions": "hysteresis", "capacitance": "hysteresis",
    "timing_skew": "hysteresis", "clip": "clip", "compliance": "clip", "range_switch": "range",
    "sensor_offset": "sensor", "sensor_nonlin": "sensor", "temp_offset": "sensor", "temperature_or_cells": "sensor",
}


def source_of(row):
    return next((name for name in SOURCES if row["source"] == name), None)


def read_table(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return {name: [float(row[k]) for row in rows[1:]] for k, name in enumerate(rows[0])}


def id_of(part, case):
    """The name in its source would tell the label."""
    return part[0] + hashlib.sha256(f"{part}/{case}".encode()).hexdigest()[:8]


def record_of(part, case, folder):
    table = read_table(folder / f"{case}.csv")
    sidecar = json.loads((folder / f"{case}.json").read_text(encoding="utf-8"))
    record = {"id": id_of(part, case), "part": part, "cells_in_series": sidecar.get("cells_in_series"),
              "modules_in_series": 1, "substrings": sidecar.get("bypass_diodes"),
              "irradiance_Wm2": sidecar.get("nominal_irradiance_Wm2"), "temperature_C": sidecar.get("nominal_temperature_C")}
    for key in ("technology", "area_cm2", "compliance_A"):
        if key in sidecar:
            record[key] = sidecar[key]
    record.update(voltage_V=table["voltage_V"], current_A=table["current_A"])
    if "sweep" in table:
        record["sweep"] = [int(k) for k in table["sweep"]]
    if "irradiance_Wm2" in table:
        record["irradiance_of_reading_Wm2"] = table["irradiance_Wm2"]
    return {key: value for key, value in record.items() if value is not None}


def truth_of(part, row):
    accepted = []
    for name in row["accepted_first_names"].split():
        if CAUSE_OF[name] not in accepted:
            accepted.append(CAUSE_OF[name])
    clean = row["label"] == "clean"
    return {"id": id_of(part, row["case"]), "case": row["case"], "cause": "none" if clean else accepted[0],
            "accepted": ["none"] if clean else sorted(accepted), "known_by": row["note"], "source": row["source"],
            "licence": SOURCES[source_of(row)][0], "parameters": {}}


def measured(folder):
    """{"real": (records, truths), "lab": ...} of a folder of labelled sweeps, in the order of their ids."""
    found = {}
    for part, below in (("real", folder / "field" / "single"), ("lab", folder / "lab")):
        with open(below / "labels.csv", newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["label"] in ("clean", "fault") and source_of(row)]
        found[part] = ([record_of(part, row["case"], below) for row in rows], [truth_of(part, row) for row in rows])
        for rows_of in found[part]:
            rows_of.sort(key=lambda row: row["id"])
    return found
