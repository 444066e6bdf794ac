"""Answers to the benchmark and its labels: how they are read, and what is wrong with them.

Plain Python 3.9 or later, no other package. An error names file, line and field, and what was expected there.
"""

import csv
import difflib
import gzip
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
FIELDS = ("id", "cause", "probability", "parameters")
COLUMNS = FIELDS[:-1] + tuple(name + end for name in PARAMETERS for end in ("", *("_" + limit for limit in LIMITS)))


class AnswerError(ValueError):
    """What is wrong with a file of answers, and where."""

    def __init__(self, file, line, field, message):
        super().__init__(": ".join(filter(None, (f"{file}:{line}" if line else str(file), field, message))))


def number_of(value, where, lowest=-math.inf, highest=math.inf):
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise AnswerError(*where, f"expected a number, got {value!r}")
    if not math.isfinite(value):
        raise AnswerError(*where, f"expected a finite number, got {value}")
    if not lowest <= value <= highest:
        raise AnswerError(*where, f"expected a number from {lowest:g} to {highest:g}, got {value:g}")
    return float(value)


def unknown(name, known):
    """What is said of a name that is not known: the one that was meant, or all."""
    meant = difflib.get_close_matches(name, known, 1)
    return "unknown; " + (f"meant may be {meant[0]}; " if meant else "") + f"known are {', '.join(known)}"


def checked_parameter(name, given, file, line):
    where = f"parameters.{name}"
    if name not in PARAMETERS:
        raise AnswerError(file, line, where, unknown(name, PARAMETERS))
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
        if key not in FIELDS:
            raise AnswerError(file, line, key, unknown(key, FIELDS))
    for key in ("id", "cause"):
        if row.get(key) in (None, ""):
            raise AnswerError(file, line, key, "missing; expected a text")
        if not isinstance(row[key], str):
            raise AnswerError(file, line, key, f"expected a text, got {row[key]!r}")
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


def number_in(cell, where):
    try:
        return float(cell)
    except ValueError:
        raise AnswerError(*where, f"expected a number, got {cell!r}") from None


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
    if "id" not in head and "cause" not in head:
        raise AnswerError(file, 1, "", "expected JSON Lines (an object a line) or a table whose first line names its columns between "
                          f"commas: id,cause,probability; got {text.splitlines()[0][:60]!r}")
    for name in head:
        if name not in COLUMNS:
            meant = difflib.get_close_matches(name, COLUMNS, 1)
            raise AnswerError(file, 1, name, f"unknown column; {'meant may be ' + meant[0] + '; ' if meant else ''}known are id, cause, "
                              f"probability, {', '.join(PARAMETERS)} and each of these with _low_95 and _high_95")
    for name in ("id", "cause"):
        if name not in head:
            raise AnswerError(file, 1, name, "column missing")
    for cells in table:
        if not cells:
            continue
        if len(cells) != len(head):
            raise AnswerError(file, table.line_num, "", f"expected {len(head)} columns, got {len(cells)}")
        filled = {name: cell if name in ("id", "cause") else number_in(cell, (file, table.line_num, name))
                  for name, cell in zip(head, cells) if cell != ""}
        parameters = {}
        for name in PARAMETERS:
            given = {key: filled[name + end] for key, end in
                     (("value", ""), ("low_95", "_low_95"), ("high_95", "_high_95")) if name + end in filled}
            if given:
                parameters[name] = given
        yield table.line_num, {**{k: filled[k] for k in ("id", "cause", "probability") if k in filled},
                               "parameters": parameters}


def read_answers(file, known=None):
    """Answers by id, which is to be one of `known`. AnswerError: file, line, field, what was expected."""
    try:
        text = pathlib.Path(file).read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise AnswerError(file, 1, "", f"cannot be read: {error}") from None
    if not text.strip():
        raise AnswerError(file, 1, "", "empty; expected a row a curve")
    if text.lstrip().startswith("["):
        raise AnswerError(file, 1, "", "expected JSON Lines (an object a line, no array and no commas between), got an array")
    rows = json_rows(text, file) if text.lstrip().startswith("{") else csv_rows(text, file)
    answers, first = {}, {}
    for line, row in rows:
        answer = checked_row(row, file, line)
        if answer["id"] in answers:
            raise AnswerError(file, line, "id", f"{answer['id']} again; first in line {first[answer['id']]}")
        if known is not None and answer["id"] not in known:
            raise AnswerError(file, line, "id", f"unknown {answer['id']!r}; expected that of a curve of the parts that are here: "
                              + ", ".join(sorted(set(known.values()), key=PARTS.index)))
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


def labels_file(part, folder):
    return folder / ("closed_labels.enc" if part == "closed" else f"{part}_labels.jsonl")


def parts_here(folder=HERE):
    return [part for part in PARTS if labels_file(part, folder).is_file()]


def known_ids(folder=HERE):
    """The part of every curve whose labels are here, by its id; the closed labels stay closed."""
    known = {}
    for part in parts_here(folder):
        if part != "closed":
            known |= dict.fromkeys(read_labels([part], folder), part)
    packed, plain = HERE / "closed.jsonl.gz", HERE / "curves" / "closed.jsonl"
    text = gzip.decompress(packed.read_bytes()).decode() if packed.is_file() else plain.read_text(encoding="utf-8")
    return known | {json.loads(line)["id"]: "closed" for line in text.splitlines()}


def read_labels(parts, folder=HERE, key=None):
    """Truths by id, each with its part."""
    labels = {}
    for part in parts:
        if not labels_file(part, folder).is_file():
            raise ValueError(f"part {part} is not in this archive, which has {', '.join(parts_here(folder)) or 'none'}; cmake/benchmark.sh "
                             "of the repository makes one with the measured curves (LYREFIT_FIELD_DATA=FOLDER)")
        if part == "closed":
            if not key:
                raise ValueError("the closed labels need a key: --key-file FILE or LYREFIT_BENCHMARK_KEY")
            text = closed_text(labels_file(part, folder), key)
        else:
            text = labels_file(part, folder).read_text(encoding="utf-8")
        for line in text.splitlines():
            truth = json.loads(line)
            if "id" in truth:
                labels[truth["id"]] = {**truth, "part": part}
    return labels


def of_these(answers, labels, file):
    """The answers to these curves, which must all be there; those to curves of other parts may be."""
    missing = sorted(set(labels) - set(answers))
    if missing:
        raise AnswerError(file, None, "id", f"{len(missing)} of {len(labels)} curves have no row, first {missing[0]}; expected a row a curve "
                          "of every part that is scored (--parts)")
    return {name: answers[name] for name in labels}
