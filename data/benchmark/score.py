#!/usr/bin/env python3
"""Scores answers to the benchmark. Plain Python 3.9 or later, no other package.

    score.py ANSWERS... [--parts open,real,lab] [--json FILE]       a table row an answer file; else all open parts that are here
    score.py ANSWERS --detail                                       by cause, by stated probability, by parameter
    score.py FIRST SECOND --compare                                 exact McNemar test on the same curves
    score.py ANSWERS --parts closed --key-file FILE                 with the closed labels (or LYREFIT_BENCHMARK_KEY)
    score.py ANSWERS --check                                        only whether the file can be scored

ANSWERS: JSON Lines or CSV, a row a curve (README.md, "What is handed in"). Limits of shares are exact ones of 95 %
(Clopper and Pearson), those of the Brier score Student's.
"""

import argparse
import json
import math
import os
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from submission import (ABSTAIN, CAUSES, PARAMETERS, PARTS, AnswerError, known_ids, labels_file, of_these,  # noqa: E402
                        parts_here, read_answers, read_labels)

# Statistics ------------------------------------------------------------------------------------------------------

def tail(k, n, p):
    """P(X >= k) of a binomial."""
    if k <= 0:
        return 1.0
    if p <= 0 or p >= 1:
        return float(p >= 1)
    logs = [math.lgamma(n + 1) - math.lgamma(i + 1) - math.lgamma(n - i + 1) + i * math.log(p)
            + (n - i) * math.log1p(-p) for i in range(k, n + 1)]
    return min(1.0, math.fsum(math.exp(value) for value in logs))


def exact_limits(k, n, level=0.95):
    """Clopper and Pearson (doi:10.1093/biomet/26.4.404)."""
    if n == 0:
        return 0.0, 1.0
    side = (1 - level) / 2

    def solve(count, target):
        low, high = 0.0, 1.0
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if tail(count, n, middle) < target else (low, middle)
        return 0.5 * (low + high)

    return (0.0 if k == 0 else solve(k, side)), (1.0 if k == n else solve(k + 1, 1 - side))


def share(flags):
    flags = list(flags)
    low, high = exact_limits(sum(flags), len(flags))
    return {"count": sum(flags), "of": len(flags), "share": sum(flags) / len(flags) if flags else None,
            "low_95": low, "high_95": high}


def mcnemar(first_only, second_only):
    """Two-sided exact p of so many curves that only one of two is right on (doi:10.1007/BF02295996)."""
    n = first_only + second_only
    return min(1.0, 2 * tail(max(first_only, second_only), n, 0.5)) if n else 1.0


def median(values):
    values = sorted(values)
    half = len(values) // 2
    return None if not values else values[half] if len(values) % 2 else 0.5 * (values[half - 1] + values[half])


def mean_with_limits(values):
    n = len(values)
    if n < 2:
        return {"value": values[0] if values else None, "of": n, "low_95": None, "high_95": None}
    mean = math.fsum(values) / n
    error = math.sqrt(math.fsum((v - mean) ** 2 for v in values) / (n - 1) / n)
    student = 1.96 + 2.4 / (n - 1) + 2.6 / (n - 1) ** 2  # 97.5 % point, to 2 % from 5 values on
    return {"value": mean, "of": n, "low_95": max(0.0, mean - student * error), "high_95": min(1.0, mean + student * error)}


# Scores ----------------------------------------------------------------------------------------------------------

def is_right(answer, truth):
    return answer["cause"] in truth["accepted"]


def error_of(value, truth, measure):
    if measure == "absolute":
        return abs(value - truth)
    if measure == "log":
        return abs(math.log(value / truth)) if value > 0 else math.inf
    if measure == "inverse":
        return abs(truth / value - 1) if value > 0 else math.inf
    return abs(value / truth - 1)


def parameter_scores(answers, labels):
    scores = {}
    for name, measure in PARAMETERS.items():
        asked = [key for key in labels if labels[key].get("parameters", {}).get(name)]  # not of curves that lost nothing
        given = [key for key in asked if name in answers[key]["parameters"]]
        if not given:
            continue
        pairs = [(answers[key]["parameters"][name], labels[key]["parameters"][name]) for key in given]
        bounded = [(a, t) for a, t in pairs if "low_95" in a]
        scores[name] = {"asked": len(asked), "answered": len(given), "error": measure,
                        "median_error": median([error_of(a["value"], t, measure) for a, t in pairs]),
                        "coverage": share(a["low_95"] <= t <= a["high_95"] for a, t in bounded)}
    return scores


def reliability(answers, labels):
    """The Brier score and, in tenths of stated probability, how often the answers are right.

    `brier` can be compared: it is None unless every answer that does not abstain states a probability, since who states only
    sure ones has a low one. `brier_of_stated` is that of those that do.
    """
    given = [key for key in labels if answers[key]["cause"] != ABSTAIN]
    stated = [(answers[key]["probability"], is_right(answers[key], labels[key])) for key in given
              if answers[key]["probability"] is not None]
    bins = []
    for tenth in range(10):
        inside = [(p, r) for p, r in stated if min(int(p * 10), 9) == tenth]
        if inside:
            bins.append({"from": tenth / 10, "stated": math.fsum(p for p, _ in inside) / len(inside),
                         "right": share(r for _, r in inside)})
    brier = mean_with_limits([(p - r) ** 2 for p, r in stated])
    return {"stated": {"count": len(stated), "of": len(given)}, "brier": brier if len(stated) == len(given) else None,
            "brier_of_stated": brier, "bins": bins}


def score(answers, labels):
    """All scores of answers (by id) against truths (by id) as a plain dict."""
    clean = [key for key in labels if labels[key]["cause"] == "none"]
    faulty = [key for key in labels if labels[key]["cause"] != "none"]
    cause = {key: answers[key]["cause"] for key in labels}
    return {
        "curves": len(labels),
        "right": share(is_right(answers[key], labels[key]) for key in labels),
        "right_name": share(is_right(answers[key], labels[key]) for key in faulty),
        "false_cause": share(cause[key] not in ("none", ABSTAIN) for key in clean),
        "missed": share(cause[key] == "none" for key in faulty),
        "wrong_name": share(cause[key] not in ("none", ABSTAIN) and not is_right(answers[key], labels[key])
                            for key in faulty),
        "abstained": share(cause[key] == ABSTAIN for key in labels),
        "by_cause": {name: share(is_right(answers[key], labels[key]) for key in labels if labels[key]["cause"] == name)
                     for name in CAUSES if any(labels[key]["cause"] == name for key in labels)},
        "calibration": reliability(answers, labels),
        "parameters": parameter_scores(answers, labels),
    }


def compare(first, second, labels):
    only = [sum(is_right(a[key], labels[key]) and not is_right(b[key], labels[key]) for key in labels)
            for a, b in ((first, second), (second, first))]
    return {"curves": len(labels), "first_only": only[0], "second_only": only[1], "p": mcnemar(*only)}


# Text ------------------------------------------------------------------------------------------------------------

def in_percent(part):
    if not part["of"]:
        return "-"
    return (f"{part['count']} of {part['of']}: {100 * part['share']:.0f} % "
            f"({100 * part['low_95']:.0f} to {100 * part['high_95']:.0f})")


def brier_text(calibration):
    """The Brier score with the count of stated probabilities; without a score where some are not stated."""
    stated, brier = calibration["stated"], calibration["brier"]
    count = f"{stated['count']} of {stated['of']} stated"
    if brier is None or brier["low_95"] is None:
        return f"- ({count})"
    return f"{mean_text(brier)}; {count}"


def mean_text(mean):
    return f"{mean['value']:.3f} ({mean['low_95']:.3f} to {mean['high_95']:.3f})"


COLUMNS = ("right_name", "false_cause", "missed", "wrong_name", "abstained")


def table(rows):
    """Rows (name, scores) as a Markdown table."""
    lines = ["| answers | right name of faulty | cause given to clean | missed | wrong name | abstained | Brier |",
             "|---|---|---|---|---|---|---|"]
    for name, scores in rows:
        cells = [name, *(in_percent(scores[key]) for key in COLUMNS), brier_text(scores["calibration"])]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def detail(scores):
    lines = ["| cause | right |", "|---|---|"]
    lines += [f"| {name} | {in_percent(part)} |" for name, part in scores["by_cause"].items()]
    calibration = scores["calibration"]
    if calibration["stated"]["count"] > 1:
        lines += ["", f"Brier score of the {calibration['stated']['count']} of {calibration['stated']['of']} answers that state a "
                  f"probability: {mean_text(calibration['brier_of_stated'])}"
                  + ("" if calibration["brier"] else ", not to be compared: the others may be the unsure ones")]
    if calibration["bins"]:
        lines += ["", "| stated | mean | right |", "|---|---|---|"]
    lines += [f"| {100 * b['from']:.0f} to {100 * b['from'] + 10:.0f} % | {100 * b['stated']:.1f} % | "
              f"{in_percent(b['right'])} |" for b in scores["calibration"]["bins"]]
    if scores["parameters"]:
        lines += ["", "| parameter | answered | median error | 95 % interval holds the truth |", "|---|---|---|---|"]
        lines += [f"| {name} | {p['answered']} of {p['asked']} | {p['median_error']:.3g} ({p['error']}) | "
                  f"{in_percent(p['coverage'])} |" for name, p in scores["parameters"].items()]
    return "\n".join(lines)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("answers", nargs="+")
    parser.add_argument("--parts", help="of open, real, lab, closed (default: those of open, real, lab that are here)")
    parser.add_argument("--labels", type=pathlib.Path, default=None, help="folder of the label files")
    parser.add_argument("--key-file", type=pathlib.Path)
    parser.add_argument("--json", metavar="FILE", help="all scores; - for standard output, alone")
    for flag in ("--detail", "--compare", "--check"):
        parser.add_argument(flag, action="store_true")
    given = parser.parse_args()
    given.folder = given.labels or (HERE / "labels" if (HERE / "labels").is_dir() else HERE)
    given.parts = given.parts.split(",") if given.parts else [part for part in parts_here(given.folder) if part != "closed"]
    for part in given.parts:
        if part not in PARTS:
            parser.error(f"unknown part {part!r}; known are {', '.join(PARTS)}")
    if given.compare and len(given.answers) != 2:
        parser.error("--compare takes two files")
    if given.json and given.json != "-":
        read = [*given.answers, *filter(None, [given.key_file]), *(labels_file(part, given.folder) for part in PARTS)]
        if pathlib.Path(given.json).exists() and any(os.path.exists(file) and os.path.samefile(file, given.json) for file in read):
            parser.error(f"--json {given.json}: would replace what is read; expected another file")
    return given


def checked(given):
    """Says of each file whether it can be scored; the closed labels are not needed for it."""
    known = known_ids(given.folder)
    read_labels([part for part in given.parts if part != "closed"], given.folder)  # are they here?
    asked = {name: part for name, part in known.items() if part in given.parts}
    for file in given.answers:
        answers = read_answers(file, known)
        of_these(answers, asked, file)
        print(f"{file}: {len(answers)} rows, can be scored on {', '.join(given.parts)}")


def main():
    given = arguments()
    if given.check:
        checked(given)
        return
    key = given.key_file.read_text(encoding="utf-8") if given.key_file else os.environ.get("LYREFIT_BENCHMARK_KEY")
    labels, known = read_labels(given.parts, given.folder, key), known_ids(given.folder)
    chosen = [(pathlib.Path(file).stem, of_these(read_answers(file, known), labels, file)) for file in given.answers]
    if given.compare:
        result = compare(chosen[0][1], chosen[1][1], labels)
        print(f"right on {result['curves']} curves: {chosen[0][0]} alone {result['first_only']}, {chosen[1][0]} alone "
              f"{result['second_only']}, exact McNemar p = {result['p']:.2g}")
        return
    scored = {name: score(answers, labels) for name, answers in chosen}
    if given.json:
        text = json.dumps(scored, indent=1) + "\n"
        if given.json == "-":
            sys.stdout.write(text)
            return
        pathlib.Path(given.json).write_text(text, encoding="utf-8")
    print(table(scored.items()))
    if given.detail:
        for name, scores in scored.items():
            print(f"\n{name}\n\n{detail(scores)}")


if __name__ == "__main__":
    try:
        main()
    except (AnswerError, ValueError, OSError) as failure:
        sys.exit(str(failure))
