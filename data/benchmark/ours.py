"""Answers of lyrefit's command to the benchmark: `diagnose` names the cause, `batch --plan` what only the data sheet of a
made curve tells, `fit --noise field` the parameters."""

import csv
import json
import pathlib
import subprocess
import tempfile
import threading

from measured import CAUSE_OF

# Causes that say what the readings are like, not what is wrong.
REMARKS = ("outliers", "quantisation", "voltage_bins")
# Causes against the data sheet. Dirt that all cells share and a light sensor that reads high are one set to the data.
PLANNED = {"bypassed_substring": "bypass_short", "cable_resistance": "series_resistance", "light_sensor": "sensor",
           "uniform_soiling": "sensor", "temperature_sensor": "sensor"}
FINDING_OF = {"leak": "shunt", "series_resistance": "series_resistance", "ideality": "cell"}


def write_curve(record, folder):
    """A table and its sidecar, as lyrefit reads them. Returns the table."""
    columns = {"voltage_V": record["voltage_V"], "current_A": record["current_A"]}
    if "sweep" in record:
        columns["sweep"] = record["sweep"]
    if "irradiance_of_reading_Wm2" in record:
        columns["irradiance_Wm2"] = record["irradiance_of_reading_Wm2"]
    path = pathlib.Path(folder) / f"{record['id']}.csv"
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(columns)
        table.writerows(zip(*columns.values()))
    sidecar = {"name": record["id"], "cells_in_series": record["cells_in_series"],
               "nominal_temperature_C": record.get("temperature_C"), "nominal_irradiance_Wm2": record.get("irradiance_Wm2"),
               "bypass_diodes": record.get("substrings")}
    sidecar.update({key: record[key] for key in ("technology", "area_cm2", "compliance_A") if key in record})
    path.with_suffix(".json").write_text(json.dumps({k: v for k, v in sidecar.items() if v is not None}),
                                         encoding="utf-8")
    return path


def run(command, *arguments):
    done = subprocess.run([command, *arguments, "--json", "-"], capture_output=True, text=True, check=False)
    try:
        return json.loads(done.stdout)
    except ValueError:
        return None


def cause_of(report):
    """Cause and stated probability of a diagnosis; abstains where it failed, or says that something unknown is there."""
    if report is None:
        return "abstain", None
    verdict = report["verdict"]
    causes = [cause for cause in verdict["causes"] if cause["id"] not in REMARKS]
    if causes:
        name = CAUSE_OF.get(causes[0]["id"], CAUSE_OF.get(causes[0].get("effect")))
        return (name, causes[0]["probability"]) if name else ("abstain", None)
    if verdict["unexplained"]:
        return "abstain", None
    findings = [FINDING_OF[f["id"]] for f in report["device_findings"] if f["id"] in FINDING_OF]
    if findings:
        return findings[0], None
    return "none", verdict["probability_none"]


def power_lost(report, record):
    """Part of the power of the healthy device that all causes take, from what could be gained."""
    if report is None or not report["verdict"]["found"]:
        return {} if report is None else {"power_lost": {"value": 0.0}}
    gain = report["verdict"]["recoverable_power_W"]
    if gain["value"] is None:
        return {}
    largest = max(v * i for v, i in zip(record["voltage_V"], record["current_A"]))
    part = {"value": gain["value"] / (gain["value"] + largest)}
    for key in ("low_95", "high_95"):
        if gain[key] is not None:
            part[key] = gain[key] / (gain[key] + largest)
    return {"power_lost": part}


def fitted(report):
    parameters = {}
    if report is None or not report["usable"]:
        return parameters
    for name in ("photocurrent", "saturation_current", "n", "resistance_series", "resistance_shunt"):
        given = report["parameters"][name]
        if given["refined"] is None or given["refined"] <= 0:
            continue
        parameters[name] = {"value": given["refined"]}
        if given["low_95"] is not None or given["high_95"] is not None:
            parameters[name].update(low_95=given["low_95"], high_95=given["high_95"])
    return parameters


def answer(command, record, folder):
    """The answer of the curve alone."""
    path = write_curve(record, folder)
    report = run(command, "diagnose", str(path), "--no-held-out", "--threads", "1")
    cause, probability = cause_of(report)
    row = {"id": record["id"], "cause": cause, "probability": probability, "parameters": {}}
    if record["part"] == "made":
        row["parameters"] = power_lost(report, record)
        if "sweep" not in record:
            row["parameters"].update(fitted(run(command, "fit", str(path), "--noise", "field", "--threads", "1")))
    row["finding"] = probability is None and cause != "abstain"
    return row


def module_of(record):
    sheet, modules = record["sheet"], record["modules_in_series"]
    return {"name": record["id"], "technology": "mono-Si", "cells_in_series": record["cells_in_series"] // modules,
            "bypass_diodes": record["substrings"] // modules,
            "rated_power_W": round(sheet["imp_A"] * sheet["vmp_V"], 1), "short_circuit_current_A": sheet["isc_A"],
            "open_circuit_voltage_V": sheet["voc_V"], "max_power_current_A": sheet["imp_A"],
            "max_power_voltage_V": sheet["vmp_V"], "alpha_sc_percent_K": sheet["alpha_isc_percent_K"],
            "beta_oc_percent_K": sheet["beta_voc_percent_K"], "gamma_pmp_percent_K": -0.35}


def planned(command, records, folder):
    """(cause, probability) against the data sheet by id, where there is one; every curve a combiner of its own."""
    folder = pathlib.Path(folder)
    plan, rows = [], []
    for record in records:
        (folder / f"{record['id']}_module.json").write_text(json.dumps(module_of(record)), encoding="utf-8")
        name, count = f"{record['id']}/string", record.get("sweep", [0] * len(record["voltage_V"])).count(0)
        plan.append({"id": name, "modules_in_series": record["modules_in_series"], "strings_in_parallel": 1,
                     "module": f"{record['id']}_module.json"})
        rows.append({"id": name, "cells_in_series": record["cells_in_series"],
                     "irradiance_W_m2": record["irradiance_Wm2"], "cell_temperature_C": record["temperature_C"],
                     "voltage_V": record["voltage_V"][:count], "current_A": record["current_A"][:count]})
    (folder / "plan.json").write_text(json.dumps(plan), encoding="utf-8")
    (folder / "rows.jsonl").write_text("".join(json.dumps(row) + "\n" for row in rows), encoding="utf-8")
    subprocess.run([command, "batch", "rows.jsonl", "--plan", "plan.json", "--task", "fit", "--out", "out", "--quiet"],
                   cwd=folder, check=False)
    found = {}
    for line in (folder / "out" / "results.jsonl").read_text(encoding="utf-8").splitlines():
        row = json.loads(line)
        if row["plan_cause"]:
            found[row["id"].split("/")[0]] = (PLANNED.get(row["plan_cause"], "abstain"), row["plan_probability"])
    return found


def answers(command, records, threads=2):
    """Two lists: the answers of the curves alone, and with the data sheets."""
    alone = [None] * len(records)

    def work(first, folder):
        for k in range(first, len(records), threads):
            alone[k] = answer(command, records[k], folder)

    with tempfile.TemporaryDirectory() as folder:
        workers = [threading.Thread(target=work, args=(first, folder)) for first in range(threads)]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
        made = [record for record in records if record["part"] == "made"]
        against = planned(command, made, folder) if made else {}
    both = []
    for row in alone:
        finding = row.pop("finding")
        told = against.get(row["id"])
        both.append({**row, "cause": told[0], "probability": told[1]} if told and (row["cause"] == "none" or finding)
                    else row)
    return alone, both
