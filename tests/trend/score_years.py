"""Scores the reports of `lyrefit trend` against the truth of simulated years.

    score_years.py --truth FOLDER --reports FOLDER [--days 10] [--within 0.3] [--rows FILE] [--json]

The report of FOLDER/NAME.truth.json is NAME.json in the other folder. A report may lack any part: what it does
not state counts as not stated, never as right. Prints

- rates: how many 95 % intervals hold the true rate, by quantity;
- onsets: how many true changes have a claim (an onset or a step) of a fitting quantity within so many days, and the
  claims that fit no true change, a module-year;
- loss: errors of the split, in % of the energy of the undamaged module, and how many intervals hold the truth.

Proportions have Wilson limits, counts a year exact Poisson limits, both of 95 %.
"""

import argparse
import csv
import datetime
import json
import math
import pathlib

import numpy as np

PARTS = ("total", "light", "resistance_series", "recombination", "shunt", "mismatch")
# What a claim may be called, as the truth calls it.
NAMES = {
    "photocurrent": "light", "soiling": "light", "shade": "light",
    "shunt": "resistance_shunt", "conductance_shunt": "resistance_shunt",
    "saturation_current": "recombination", "n": "recombination", "diode_factor": "recombination",
    "bypass": "mismatch",
}
GENERAL = {"power", "p_mp", "total", "loss"}  # fit any true change


def named(quantity):
    return NAMES.get(quantity, quantity)


def wilson(hits, count, z=1.96):
    if count == 0:
        return float("nan"), float("nan")
    share, zz = hits / count, z * z / count
    middle = (share + zz / 2) / (1 + zz)
    half = z / (1 + zz) * math.sqrt(share * (1 - share) / count + zz / (4 * count))
    return middle - half, middle + half


def poisson_at_most(count, mean):
    term = total = math.exp(-mean)
    for k in range(1, count + 1):
        term *= mean / k
        total += term
    return total


def poisson(count, level=0.025):
    """Exact limits of the mean of a count."""

    def solve(target, k):
        low, high = 0.0, 10.0 + 3.0 * count
        for _ in range(100):
            middle = (low + high) / 2
            low, high = (middle, high) if poisson_at_most(k, middle) > target else (low, middle)
        return low

    return (solve(1 - level, count - 1) if count else 0.0), solve(level, count)


def day(text):
    return datetime.date.fromisoformat(str(text)[:10]).toordinal()


def complete(figure, *keys):
    """Whether a figure of a report is a number with its interval."""
    return isinstance(figure, dict) and all(isinstance(figure.get(key), (int, float)) for key in keys)


def holds(figure, truth):
    slack = 1e-9 * abs(truth)
    return figure["low_95"] - slack <= truth <= figure["high_95"] + slack


def in_percent(quantity):
    return str(quantity.get("unit", "")).startswith("%")


def rates_of(truth, report):
    stated = {named(quantity["name"]): quantity for quantity in report.get("quantities", [])}
    for quantity in truth["quantities"]:
        if quantity["rate_per_year"] is None:
            continue
        claim = stated.get(quantity["name"], {})
        other = claim.get("unit", quantity["unit"]) != quantity["unit"] and not in_percent(claim)
        if other and quantity["rate_per_year"] != 0:
            continue  # a conductance, a voltage: only "does not change" can be compared
        rate = claim.get("rate_per_year")
        true = quantity["rate_percent_per_year"] if in_percent(claim) else quantity["rate_per_year"]
        row = {"quantity": quantity["name"], "truth": true, "stated": complete(rate, "value", "low_95", "high_95")}
        if row["stated"]:
            row.update(value=rate["value"], low=rate["low_95"], high=rate["high_95"], holds=holds(rate, true))
            # In per cent of the first value, so that modules can be put side by side.
            scale = 1 if in_percent(claim) or other else 100 / quantity["at_start"]
            row.update(error=scale * (rate["value"] - true), half=scale * (rate["high_95"] - rate["low_95"]) / 2)
        yield row


# What happened, by the id of the cause that a report names. A shunt alone is how PID begins.
CAUSES = {
    "lost_substrings": "bypass_short",
    "series_resistance_step": "series_step",
    "potential_induced_degradation": "pid",
    "growing_shunt": "pid",
}


def claims_of(report):
    for onset in report.get("onsets", []):
        yield {"day": day(onset["date"]), "quantity": named(onset.get("quantity", "")),
               "cause": CAUSES.get(onset.get("id"), onset.get("cause", "")), "step": None}
    for quantity in report.get("quantities", []):
        for step in quantity.get("steps", []):
            yield {"day": day(step["date"]), "quantity": named(quantity["name"]), "cause": "", "step": step}


def fits(claim, onset):
    quantity = claim["quantity"]
    if claim["cause"] and claim["cause"] == onset["cause"]:
        return True
    return not quantity or quantity in GENERAL or quantity in onset["quantities"]


def is_false(claim, truth, days):
    """A claim is false if its quantity changes not at all, or by steps alone and none is near."""
    if any(abs(claim["day"] - day(onset["date"])) <= days for onset in truth["onsets"]):
        return False  # another name for what happened
    quantity, effects = claim["quantity"], truth["effects"]
    if quantity in GENERAL or not quantity:
        return not truth["varies"]
    if quantity not in truth["varies"]:
        return True
    after_pid = "pid" in effects and claim["day"] >= day(effects["pid"]["date"])
    gradual = {
        "light": True,
        "mismatch": effects.get("snow", False) or after_pid,
        "resistance_series": "series_percent_per_year" in effects,
        "recombination": "recombination_percent_per_year" in effects or after_pid,
        "resistance_shunt": after_pid,
    }
    return not gradual.get(quantity, False)


def onsets_of(truth, report, days):
    claims = list(claims_of(report))
    for onset in truth["onsets"]:
        near = [claim for claim in claims if abs(claim["day"] - day(onset["date"])) <= days]
        fitting = [claim for claim in near if fits(claim, onset)]
        row = {"cause": onset["cause"], "found": bool(fitting), "near": bool(near)}
        row["named"] = any(claim["cause"] == onset["cause"] for claim in near)
        row["late"] = min((claim["day"] - day(onset["date"]) for claim in fitting), key=abs, default=None)
        yield row


def sizes_of(truth, report, days):
    """Steps of a quantity: whether the interval of the size holds the true one."""
    stated = {quantity["name"]: quantity for quantity in report.get("quantities", [])}
    for quantity in truth["quantities"]:
        for step in quantity["steps"]:
            for claim in stated.get(quantity["name"], {}).get("steps", []):
                near = abs(day(claim["date"]) - day(step["date"])) <= days
                if near and complete(claim.get("size"), "low_95", "high_95"):
                    yield holds(claim["size"], step["size"])


def true_loss(truth, report, part):
    """Loss over all days less that of a usual reference day, in % of the undamaged energy."""
    if "reference_end" not in report or "daily" not in truth:
        return truth["loss"]["energy_percent"][part]
    if part == "total":
        return sum(true_loss(truth, report, one) for one in PARTS[1:])
    daily, end = truth["daily"], report["reference_end"][:10]
    days = [(date, whole, missing) for date, whole, missing
            in zip(daily["date"], daily["undamaged_Wh"], daily["lost_Wh"][part]) if whole > 0]
    shaded = {date for date, whole, light, mismatch
              in zip(daily["date"], daily["undamaged_Wh"], daily["lost_Wh"]["light"], daily["lost_Wh"]["mismatch"])
              if whole > 0 and light + mismatch > 0.15 * whole}
    usual = [missing / whole for date, whole, missing in days if date <= end and date not in shaded]
    usual = np.median(usual) if usual else 0.0  # not under snow
    return 100 * (sum(day[2] for day in days) / sum(day[1] for day in days) - usual)


def losses_of(truth, report):
    stated = report.get("loss", {}).get("energy_percent", {})
    for part in PARTS:
        figure, true = stated.get(part), true_loss(truth, report, part)
        row = {"part": part, "truth": true, "stated": complete(figure, "value")}
        if row["stated"]:
            row.update(value=figure["value"], error=figure["value"] - true)
            row["interval"] = complete(figure, "low_95", "high_95")
            if row["interval"]:
                row.update(low=figure["low_95"], high=figure["high_95"], holds=holds(figure, true))
        yield row


def score(pairs, days, within):
    rates, onsets, sizes, losses, false = [], [], [], [], []
    years = clean_years = clean_false = 0
    for name, truth, report in pairs:
        span = (day(truth["end"]) - day(truth["start"]) + 1) / 365.25
        years += span
        for rows, found in ((rates, rates_of(truth, report)), (onsets, onsets_of(truth, report, days)),
                            (losses, losses_of(truth, report))):
            rows.extend({"year": name, **row} for row in found)
        sizes.extend(sizes_of(truth, report, days))
        wrong = [claim for claim in claims_of(report) if is_false(claim, truth, days)]
        false.extend({"year": name, "quantity": claim["quantity"]} for claim in wrong)
        if not truth["onsets"]:
            clean_years += span
            clean_false += len(wrong)
    return {"years": years, "rates": rates, "onsets": onsets, "sizes": sizes, "losses": losses, "false": false,
            "clean_years": clean_years, "clean_false": clean_false, "days": days, "within": within}


def share_text(hits, count):
    if count == 0:
        return "none"
    low, high = wilson(hits, count)
    return f"{hits}/{count} = {100 * hits / count:.1f} % ({100 * low:.1f} to {100 * high:.1f})"


def summary(scored):
    """The figures of the text, as a tree."""
    tree = {"rates": {}, "onsets": {}, "loss": {}}

    def share(rows, key):
        hits = sum(bool(row[key]) for row in rows)
        return {"hits": hits, "count": len(rows), "limits": wilson(hits, len(rows))}

    for quantity in dict.fromkeys(row["quantity"] for row in scored["rates"]):
        rows = [row for row in scored["rates"] if row["quantity"] == quantity]
        stated = [row for row in rows if row["stated"]]
        entry = {"modules": len(rows), "stated": len(stated), "holds": share(stated, "holds")}
        if stated:
            entry["rms_percent_per_year"] = float(np.sqrt(np.mean([row["error"] ** 2 for row in stated])))
            entry["median_half_width"] = float(np.median([row["half"] for row in stated]))
        tree["rates"][quantity] = entry
    for cause in ["all", *dict.fromkeys(row["cause"] for row in scored["onsets"])]:
        rows = [row for row in scored["onsets"] if cause in ("all", row["cause"])]
        tree["onsets"][cause] = {key: share(rows, key) for key in ("found", "near", "named")}
    for part in PARTS:
        rows = [row for row in scored["losses"] if row["part"] == part]
        stated = [row for row in rows if row["stated"]]
        entry = {"modules": len(rows), "stated": len(stated)}
        if stated:
            errors = np.abs([row["error"] for row in stated])
            entry.update(rms=float(np.sqrt(np.mean(errors**2))), p95=float(np.percentile(errors, 95)),
                         mean=float(np.mean([row["error"] for row in stated])))
            hits = int(np.sum(errors <= scored["within"]))
            entry["within"] = {"hits": hits, "count": len(stated), "limits": wilson(hits, len(stated))}
            entry["holds"] = share([row for row in stated if row["interval"]], "holds")
        tree["loss"][part] = entry
    count, clean = len(scored["false"]), scored["clean_false"]
    by_quantity = {}
    for claim in scored["false"]:
        by_quantity[claim["quantity"]] = by_quantity.get(claim["quantity"], 0) + 1
    tree["false"] = {"count": count, "years": scored["years"], "limits": poisson(count), "by_quantity": by_quantity}
    tree["false_without_onset"] = {"count": clean, "years": scored["clean_years"], "limits": poisson(clean)}
    tree["step_sizes"] = {"hits": sum(scored["sizes"]), "count": len(scored["sizes"])}
    return tree


def text_of(scored):
    tree = summary(scored)
    lines = [f"{scored['years']:.1f} module-years", "", "Rates: 95 % intervals that hold the truth"]
    for quantity, entry in tree["rates"].items():
        line = f"  {quantity:18s} {share_text(entry['holds']['hits'], entry['holds']['count'])}"
        if entry["stated"]:
            line += f", rms error {entry['rms_percent_per_year']:.3g} %/year, half width {entry['median_half_width']:.3g}"
        lines.append(line + f", not stated {entry['modules'] - entry['stated']}")
    lines.append(f"  sizes of steps     {share_text(tree['step_sizes']['hits'], tree['step_sizes']['count'])}")
    lines += ["", f"Onsets within {scored['days']} days: found; any claim near; with the right cause"]
    for cause, entry in tree["onsets"].items():
        shares = (share_text(entry[key]["hits"], entry[key]["count"]) for key in ("found", "near", "named"))
        lines.append(f"  {cause:18s} {'; '.join(shares)}")
    for title, key in (("False claims", "false"), ("of years without an onset", "false_without_onset")):
        entry = tree[key]
        if entry["years"]:
            low, high = (limit / entry["years"] for limit in entry["limits"])
            lines.append(f"  {title}: {entry['count']} in {entry['years']:.1f} years = "
                         f"{entry['count'] / entry['years']:.3f} a year ({low:.3f} to {high:.3f})")
    lines += [f"    {quantity or 'no quantity'}: {count}" for quantity, count in tree["false"]["by_quantity"].items()]
    lines += ["", f"Loss, % of energy: rms error, 95th percentile, mean; within {scored['within']}; intervals that hold"]
    for part, entry in tree["loss"].items():
        line = f"  {part:18s} "
        if entry["stated"]:
            line += f"{entry['rms']:.3f} {entry['p95']:.3f} {entry['mean']:+.3f}; "
            line += "; ".join(share_text(entry[key]["hits"], entry[key]["count"]) for key in ("within", "holds"))
        lines.append(line + f", not stated {entry['modules'] - entry['stated']}")
    return "\n".join(lines) + "\n"


def write_rows(path, scored):
    """One row a judged figure, to look at what is wrong."""
    keys = ["kind", "year", "quantity", "truth", "value", "low", "high", "error", "holds", "found", "late"]
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, keys, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        for kind, label in (("rates", "quantity"), ("onsets", "cause"), ("losses", "part"), ("false", "quantity")):
            writer.writerows({**row, "kind": kind, "quantity": row[label]} for row in scored[kind])


def read_pairs(truths, reports):
    """The truths with their reports, and the names of truths without one."""
    pairs, missing = [], []
    for path in sorted(pathlib.Path(truths).glob("*.truth.json")):
        name = path.name.removesuffix(".truth.json")
        report = pathlib.Path(reports) / f"{name}.json"
        if report.exists():
            pairs.append((name, json.loads(path.read_text()), json.loads(report.read_text())))
        else:
            missing.append(name)
    return pairs, missing


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--truth", required=True)
    parser.add_argument("--reports", required=True)
    parser.add_argument("--days", type=float, default=10, help="an onset is found within so many days")
    parser.add_argument("--within", type=float, default=0.3, help="bound of the loss split, %% of energy")
    parser.add_argument("--rows", help="CSV file of all judged figures")
    parser.add_argument("--json", action="store_true")
    asked = parser.parse_args()
    pairs, missing = read_pairs(asked.truth, asked.reports)
    if not pairs:
        parser.exit(1, f"no truth in {asked.truth} has a report in {asked.reports}\n")
    scored = score(pairs, asked.days, asked.within)
    if asked.rows:
        write_rows(asked.rows, scored)
    print(json.dumps(summary(scored)) if asked.json else text_of(scored), end="")
    if missing:
        print(f"without a report: {', '.join(missing)}")


if __name__ == "__main__":
    main()
