#!/usr/bin/env python3
"""Answers the benchmark by simple means and by lyrefit, a file of answers each.

    baselines.py --out answers [--only none,thumb,neighbour,lyrefit] [--lyrefit COMMAND] [--field FOLDER]

    none        nothing is wrong with any curve, stated with the share of clean curves in the recipe
    thumb       rules on the fill factor, the slope at Isc and Voc, steps and the data sheet, written down before scoring
    neighbour   cause of the most alike labelled curve (leave-one-out on the open parts)
    lyrefit     `lyrefit diagnose`, and beside it what the data sheet tells (`lyrefit_curve`: without)

The measured curves come from --field (data/benchmark/measured.py); without it only the made ones are answered.
"""

import argparse
import gzip
import json
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import measured  # noqa: E402
import ours  # noqa: E402
import recipe  # noqa: E402


def shape_of(record):
    """The first sweep as 40 currents in parts of Isc over V / Voc, and key figures."""
    count = record.get("sweep", [0] * len(record["voltage_V"])).count(0)
    v, i = np.array(record["voltage_V"][:count]), np.array(record["current_A"][:count])
    order = np.argsort(v, kind="stable")
    v, i = v[order], i[order]
    isc = float(np.interp(0.0, v, i))
    beyond = np.nonzero(i <= 0)[0]
    voc = float(v[-1] if not len(beyond) else v[beyond[0]])
    currents = np.interp(np.linspace(0, 0.99, 40) * voc, v, i) / isc
    power = v * i
    best = int(np.argmax(power))
    return {"currents": currents, "isc": isc, "voc": voc, "vmp": float(v[best]), "imp": float(i[best]),
            "ff": float(power[best] / (isc * voc))}


def loop_of(record):
    """How far two directions are apart, in parts of Isc (rms); 0 of one direction."""
    sweep = np.array(record.get("sweep", [0]))
    if len(set(sweep.tolist())) < 2 or "irradiance_of_reading_Wm2" in record:
        return 0.0
    v, i = np.array(record["voltage_V"]), np.array(record["current_A"])
    grids = []
    for number in (0, 1):
        order = np.argsort(v[sweep == number], kind="stable")
        grids.append((v[sweep == number][order], i[sweep == number][order]))
    common = np.linspace(max(g[0][0] for g in grids), min(g[0][-1] for g in grids), 100)
    apart = np.interp(common, *grids[0]) - np.interp(common, *grids[1])
    return float(np.sqrt(np.mean(apart ** 2)) / np.max(np.abs(i)))


def rule_of_thumb(record):
    shape = shape_of(record)
    if "irradiance_of_reading_Wm2" in record:
        return "cell"
    if loop_of(record) > 0.01:
        return "hysteresis"
    i = shape["currents"]
    flat_top = np.sum(np.abs(i[:12] - i[0]) < 1e-6) == 12
    if flat_top:
        return "clip"
    before = i[:int(40 * 0.9 * shape["vmp"] / shape["voc"])]
    if len(before) > 4 and float(np.max(before[1:] - before[:-1])) > 0.02:
        return "light"
    if len(before) > 4 and float(np.max(before[:-1] - before[1:])) > 0.04:
        return "shade"
    if "sheet" in record:
        sheet, modules = record["sheet"], record["modules_in_series"]
        isc = sheet["isc_A"] * record["irradiance_Wm2"] / 1000
        voc = sheet["voc_V"] * modules * (1 + sheet["beta_voc_percent_K"] / 100 * (record["temperature_C"] - 25))
        if shape["isc"] / isc > 1.08 or abs(shape["voc"] / voc - 1) > 0.06:
            return "sensor" if shape["voc"] / voc > 0.9 else "bypass_short"
        if shape["voc"] / voc < 1 - 0.7 / record["substrings"]:
            return "bypass_short"
    if (1 - i[20]) > 0.05:
        return "shunt"
    if shape["ff"] < 0.70:
        return "series_resistance"
    return "none"


def nearest(record, others):
    shape = record["shape"]["currents"]
    best = min(others, key=lambda other: float(np.sum((shape - other["shape"]["currents"]) ** 2)))
    return best["cause"]


def plain_rows(causes):
    return [{"id": name, "cause": cause} for name, cause in causes.items()]


def read_made(half):
    with gzip.open(HERE / f"{half}.jsonl.gz", "rt", encoding="utf-8") as file:
        return [json.loads(line) for line in file]


def labels_of(parts):
    rows = {}
    for part in parts:
        for line in (HERE / f"{part}_labels.jsonl").read_text(encoding="utf-8").splitlines():
            truth = json.loads(line)
            rows[truth["id"]] = truth["cause"]
    return rows


def write(path, rows):
    path.write_text("".join(json.dumps(rounded(row), separators=(",", ":")) + "\n" for row in rows), encoding="utf-8")


def rounded(value):
    """Six digits are enough, and keep the files small."""
    if isinstance(value, float):
        return float(f"{value:.6g}")
    if isinstance(value, dict):
        return {key: rounded(part) for key, part in value.items() if part not in ({}, None) or key == "high_95"}
    return value


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=HERE / "answers")
    parser.add_argument("--only", default="none,thumb,neighbour,lyrefit")
    parser.add_argument("--lyrefit", default="lyrefit")
    parser.add_argument("--field", type=pathlib.Path)
    given = parser.parse_args()
    records = read_made("open") + read_made("closed")
    parts = ["open"]
    if given.field:
        found = measured.measured(given.field)
        records += found["real"][0] + found["lab"][0]
        parts += ["real", "lab"]
    given.out.mkdir(parents=True, exist_ok=True)
    only = given.only.split(",")
    if "none" in only:
        write(given.out / "none.jsonl", [{"id": record["id"], "cause": "none", "probability": recipe.CAUSES["none"][0]} for record in records])
    if "thumb" in only:
        write(given.out / "thumb.jsonl", plain_rows({record["id"]: rule_of_thumb(record) for record in records}))
    if "neighbour" in only:
        known = labels_of(parts)
        shaped = [{"id": record["id"], "shape": shape_of(record), "cause": known.get(record["id"])} for record in records]
        labelled = [record for record in shaped if record["cause"]]
        write(given.out / "neighbour.jsonl", plain_rows({record["id"]: nearest(
            record, [other for other in labelled if other["id"] != record["id"]]) for record in shaped}))
    if "lyrefit" in only:
        alone, both = ours.answers(given.lyrefit, records)
        write(given.out / "lyrefit_curve.jsonl", [{**row, "parameters": {}} for row in alone])
        write(given.out / "lyrefit.jsonl", both)


if __name__ == "__main__":
    main()
