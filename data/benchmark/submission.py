"""Answers to the benchmark and its labels: how they are read, and what is wrong with them.

Plain Python 3.9 or later, no other package. An error names file, line and field, and what was expected there.
"""

import csv
import hashlib
import json
import math
import pathlib
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
PARTS = ("open", "real", "lab", "closed")
CAUSES = ("none", "shade", "bypass_short", "bypass_open", "mismatch", "series_resistance", "shunt", "cell", "light",
          "sensor", "hysteresis", "clip", "range")
ABSTAIN = "abstain"
# What is asked of a curve besides its cause, and the measure of its error.
PARAMETERS = {"photocurrent": "relative", "saturation_current": "log", "n": "relative",
              "resistance_series": "relative", "resistance_shunt": "inverse", "power_lost": "absolute"}
LIMITS = ("low_95", "high_95")


class AnswerError(ValueError):
    """What is wrong with a file of answers, and where."""

    def __init__(self, file, line, field, message):
        super().__init__(f"{file}:{line}: {field}: {message}" if field else f"{file}:{line}: {message}")


def number_of(value, where, lowest=-math.inf, highest=math.inf):
    if isinstance(value, str):
        try:
            value = float(value)
        except ValueError:
            raise AnswerError(*where, f"expected a number, got {value!r}") from None
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise AnswerError(*where, f"expected a number, got {value!r}")
    if not math.isfinite(value):
        raise AnswerError(*where, f"expected a finite number, got {value}")
    if not lowest <= value <= highest:
        raise AnswerError(*where, f"expected a number from {lowest:g} to {highest:g}, got {value:g}")
    return float(value)


def checked_parameter(name, given, file, line):
    where = f"parameters.{name}"
    if name not in PARAMETERS:
        raise AnswerError(file, line, where, f"unknown; known are {', '.join(PARAMETERS)}")
    if not isinstance(given, dict) or "value" not in given:
        raise AnswerError(file, line, where, 'expected an object with "value", and "low_95", "high_95" if known')
    for key in given:
        if key not in ("value", *LIMITS):
            raise AnswerError(file, line, f"{where}.{key}", "unknown; known are value, low_95, high_95")
    lowest = -math.inf if name == "power_lost" else 0.0
    answer = {"value": number_of(given["value"], (file, line, f"{where}.value"), lowest)}
    if any(key in given for key in LIMITS):
        for key, end in zip(LIMITS, (-math.inf, math.inf)):
            value = given.get(key)
            answer[key] = end if value is None else number_of(value, (file, line, f"{where}.{key}"))
        if answer["low_95"] > answer["high_95"]:
            raise AnswerError(file, line, where, f"low_95 {answer['low_95']:g} above high_95 {answer['high_95']:g}")
    return answer


def checked_row(row, file, line):
    if not isinstance(row, dict):
        raise AnswerError(file, line, "", "expected an object")
    for key in row:
        if key not in ("id", "cause", "probability", "parameters"):
            raise AnswerError(file, line, key, "unknown; known are id, cause, probability, parameters")
    for key in ("id", "cause"):
        if not isinstance(row.get(key), str) or not row[key]:
            raise AnswerError(file, line, key, "missing; expected a text")
    if row["cause"] != ABSTAIN and row["cause"] not in CAUSES:
        raise AnswerError(file, line, "cause", f"unknown {row['cause']!r}; known are {', '.join(CAUSES)}, {ABSTAIN}")
    probability = row.get("probability")
    if probability is not None:
        probability = number_of(probability, (file, line, "probability"), 0.0, 1.0)
    parameters = row.get("parameters") or {}
    if not isinstance(parameters, dict):
        raise AnswerError(file, line, "parameters", "expected an object")
    return {"id": row["id"], "cause": row["cause"], "probability": probability,
            "parameters": {name: checked_parameter(name, given, file, line) for name, given in parameters.items()}}


def json_rows(text, file):
    for line, content in enumerate(text.splitlines(), 1):
        if content.strip():
            try:
                yield line, json.loads(content)
            except ValueError as error:
                raise AnswerError(file, line, "", f"not JSON: {error}") from None


def csv_rows(text, file):
    table = csv.reader(text.splitlines())
    head = next(table, [])
    known = {"id", "cause", "probability"} | {n + end for n in PARAMETERS for end in ("", "_low_95", "_high_95")}
    for name in head:
        if name not in known:
            raise AnswerError(file, 1, name, f"unknown column; known are {', '.join(sorted(known))}")
    for name in ("id", "cause"):
        if name not in head:
            raise AnswerError(file, 1, name, "column missing")
    for cells in table:
        if not cells:
            continue
        if len(cells) != len(head):
            raise AnswerError(file, table.line_num, "", f"expected {len(head)} columns, got {len(cells)}")
        filled = {name: cell for name, cell in zip(head, cells) if cell != ""}
        parameters = {}
        for name in PARAMETERS:
            given = {key: filled[name + end] for key, end in
                     (("value", ""), ("low_95", "_low_95"), ("high_95", "_high_95")) if name + end in filled}
            if given:
                parameters[name] = given
        yield table.line_num, {**{k: filled[k] for k in ("id", "cause", "probability") if k in filled},
                               "parameters": parameters}


def read_answers(file):
    """Answers by id. AnswerError: file, line, field, what was expected."""
    try:
        text = pathlib.Path(file).read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise AnswerError(file, 1, "", f"cannot be read: {error}") from None
    if not text.strip():
        raise AnswerError(file, 1, "", "empty; expected a row a curve")
    rows = json_rows(text, file) if text.lstrip().startswith("{") else csv_rows(text, file)
    answers, first = {}, {}
    for line, row in rows:
        answer = checked_row(row, file, line)
        if answer["id"] in answers:
            raise AnswerError(file, line, "id", f"{answer['id']} again; first in line {first[answer['id']]}")
        answers[answer["id"]], first[answer["id"]] = answer, line
    if not answers:
        raise AnswerError(file, 1, "", "no rows; expected one a curve")
    return answers


def closed_text(file, key):
    """The closed labels, decrypted and held against their published digest."""
    run = subprocess.run(["openssl", "enc", "-d", "-aes-256-cbc", "-pbkdf2", "-iter", "200000", "-md", "sha256", "-a",
                          "-in", str(file), "-pass", "stdin"], input=key.strip().encode() + b"\n", capture_output=True,
                         check=False)
    expected = pathlib.Path(f"{file}.sha256").read_text(encoding="utf-8").split()[0]
    if run.returncode or hashlib.sha256(run.stdout).hexdigest() != expected:
        raise ValueError(f"{file}: this key does not open the labels whose digest is {expected}")
    return run.stdout.decode()


def read_labels(parts, folder=HERE, key=None):
    """Truths by id, each with its part."""
    labels = {}
    for part in parts:
        if part == "closed":
            if not key:
                raise ValueError("the closed labels need a key: --key-file FILE or LYREFIT_BENCHMARK_KEY")
            text = closed_text(folder / "closed_labels.enc", key)
        else:
            text = (folder / f"{part}_labels.jsonl").read_text(encoding="utf-8")
        for line in text.splitlines():
            truth = json.loads(line)
            if "id" in truth:
                labels[truth["id"]] = {**truth, "part": part}
    return labels


def of_these(answers, labels, file):
    """The answers to these curves, which must all be there; those to curves of other parts may be."""
    missing = sorted(set(labels) - set(answers))
    if missing:
        raise AnswerError(file, 1, "id", f"{len(missing)} of {len(labels)} curves have no row, first {missing[0]}")
    return {name: answers[name] for name in labels}
