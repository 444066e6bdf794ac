#!/usr/bin/env python3
"""Whether two builds of the command do the same, byte for byte, or whether one does nothing that sanitizers report: see
cmake/same.sh and cmake/sanitize.sh."""

import argparse
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile
import threading
import time
import zlib

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE.parent / "stable"))

import names
from cases import SWEEPS, all_cases
from corpus import NAMES as KINDS
from corpus import corpus_cases
from running import MASKS, Runner, differences, faults
from rounding import Rounding

DIFFERENT, NOT_COMPARED = 1, 3  # exit codes


def links_of(folders):
    """Data folders by the name that commands see: that of the folder, with a number where it is taken."""
    links = {}
    for folder in folders:
        path = pathlib.Path(folder).resolve(strict=True)
        name, number = path.name, 1
        while name in links:
            number += 1
            name = f"{path.name}{number}"
        links[name] = path
    return links


def accepted(file):
    """Reasons by the name of the case, from a file with a line for each: name, reason."""
    reasons = {}
    for line in file.read_text(encoding="utf-8").splitlines() if file else []:
        name, _, reason = line.strip().partition(" ")
        if name and not name.startswith("#"):
            if not reason.strip():
                sys.exit(f"{file}: no reason for {name}")
            reasons[name] = reason.strip()
    return reasons


def compare(cases, old, new, links, work, *, jobs=1, limit=60.0, masks=MASKS, relative=None, tell=lambda text: None):
    """(case, seconds of both, differences or None if both hit the limit) of each case, in the order of the cases. Cases
    that take longest run first. Without a new build: faults of the old one instead of differences. Given a relative tolerance,
    a `Rounding` stands for differences that are no more than that."""
    order = sorted(range(len(cases)), key=lambda number: -cases[number].seconds)
    results = [None] * len(cases)
    lock, next_place, failures = threading.Lock(), iter(order), []
    counts = {"done": 0, "different": 0}

    def work_through(folder):
        runner = Runner(folder, links, limit)
        while not failures:
            with lock:
                number = next(next_place, None)
            if number is None:
                return
            outcomes = [runner.run(cases[number], binary) for binary in (old, new) if binary]
            if all(outcome.parts is None for outcome in outcomes):
                found = None
            else:
                found = differences(*outcomes, masks, relative) if new else faults(*outcomes)
            results[number] = (cases[number], [outcome.seconds for outcome in outcomes], found)
            with lock:
                counts["done"] += 1
                counts["different"] += isinstance(found, list) and bool(found)
                tell(f"{counts['done']} of {len(cases)} cases, {counts['different']} {'different' if new else 'with faults'}")

    def work_or_fail(folder):
        try:
            work_through(folder)
        except BaseException as error:  # what a thread raises is raised by the caller
            failures.append(error)

    threads = [threading.Thread(target=work_or_fail, args=(work / f"job{number}",)) for number in range(jobs)]
    try:
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    except BaseException as error:
        failures.append(error)
        Runner.end_all()
        raise
    if failures:
        raise failures[0]
    return results


def by_hand(case, binary, links):
    """A line of shell that runs a case."""
    parts = ["cd $(mktemp -d)", "ln -s " + " ".join(shlex.quote(str(path)) for path in links.values()) + " ."]
    for name, text in case.given:
        folder = os.path.dirname(name)
        parts += ([f"mkdir -p {folder}"] if folder else []) + [f"printf %s {shlex.quote(text)} > {name}"]
    return " && ".join(parts) + " && { " + case.shown(binary) + " ; }"


def flags_without_case(binary, cases):
    """Verbs, flags and values that the help of a build names and no case gives."""
    try:
        entries = names.command_flags(binary, ROOT)
    except (OSError, subprocess.CalledProcessError, UnicodeDecodeError):
        return []
    given = set()
    for step in (step for case in cases for step in case.steps):
        verb = step.arguments[0] if step.arguments and not step.arguments[0].startswith("-") else "lyrefit"
        given.add(verb)
        for word, after in zip(step.arguments, [*step.arguments[1:], ""]):
            flag, _, value = word.partition("=")
            given.update([f"{verb}({flag})", f"{verb} {flag} {value or after}"])
    return [name for name, entry in entries.items()
            if name not in given and not name.startswith("exit code") and "(-" in name or entry.notes == "value"]


SAME, UNLIKE, ACCEPTED, MISSED, ROUNDED = range(1, 6)  # columns of the table of results


def verdict(case, found, reasons):
    if found is None:
        return MISSED
    if isinstance(found, Rounding):
        return ROUNDED
    return SAME if not found else ACCEPTED if case.name in reasons else UNLIKE


def report(results, reasons, old, new, links, relative=None):
    """Prints what was found; returns the exit code."""
    table = {}
    judged = [(case, seconds, found, verdict(case, found, reasons)) for case, seconds, found in results]
    for case, seconds, found, what in judged:
        row = table.setdefault(case.verb, [0] * 6 + [0.0] * 2)
        row[0] += 1
        row[what] += 1
        row[6] += seconds[0]
        row[7] += seconds[-1]
    for case, _, found, what in judged:
        if what == UNLIKE:
            print(f"\n{'DIFFERENT' if new else 'FAULT'} {case.name}")
            for part, lines in found:
                print(f"  {part}", *(f"    {line}" for line in lines), sep="\n")
            print("  by hand:", *(f"    {by_hand(case, binary, links)}" for binary in (old, new) if binary), sep="\n")
    for case, _, found, what in judged:
        if what == ACCEPTED:
            print(f"\naccepted {case.name}: {reasons[case.name]}\n  {case.shown()}")
            print(*(f"  {part}" for part, _ in found), sep="\n")
    for case, _, _, what in judged:
        if what == MISSED:
            print(f"\nNOT {'COMPARED, both' if new else 'JUDGED, it'} hit the limit: {case.name}\n  {case.shown()}")
    equal = {case.name for case, _, _, what in judged if what == SAME}
    for name in reasons:
        if name in equal:
            print(f"\nno longer different: {name}")
    total = [sum(column) for column in zip(*table.values())] or [0] * 8
    heads = {0: "cases", SAME: "same", ROUNDED: "rounding", UNLIKE: "different", ACCEPTED: "accepted", MISSED: "not compared",
             6: "s old", 7: "s new"}
    if not new:
        heads = {0: "cases", SAME: "clean", UNLIKE: "faults", ACCEPTED: "accepted", MISSED: "not judged", 6: "s"}
    elif relative is None:
        del heads[ROUNDED]
    widths = {column: max(9, len(head) + 2) for column, head in heads.items()}
    print(f"\n{'verb':12}" + "".join(f"{heads[column]:>{width}}" for column, width in widths.items()))
    for verb, row in [*table.items(), ("all", total)]:
        cells = (f"{row[column]:.1f}" if column > 5 else f"{row[column]}" for column in widths)
        print(f"{verb:12}" + "".join(f"{cell:>{width}}" for cell, width in zip(cells, widths.values())))
    for verb in table:
        of_verb = [(case, found) for case, _, found, what in judged if what == ROUNDED and case.verb == verb]
        if of_verb:
            case, found = max(of_verb, key=lambda pair: (pair[1].largest, pair[1].last_digits))
            print(f"{verb}: equal but for rounding {len(of_verb)}, {sum(each.numbers for _, each in of_verb)} numbers, the largest "
                  f"difference {found.largest:.1e} ({case.name}), {sum(each.last_digits for _, each in of_verb)} by one in the last "
                  "printed digit")
    return DIFFERENT if total[UNLIKE] else NOT_COMPARED if total[MISSED] else 0


def arguments():
    parser = argparse.ArgumentParser(prog="same.sh", description=__doc__)
    parser.add_argument("old", type=pathlib.Path, nargs="?", metavar="OLD")
    parser.add_argument("new", type=pathlib.Path, nargs="?", metavar="NEW")
    parser.add_argument("--full", action="store_true", help="all files of a folder, and cases that take minutes")
    parser.add_argument("--sanitized", action="store_true", help="OLD alone, a build with sanitizers: no case may end by a "
                        "signal or with their report")
    parser.add_argument("--sweeps", type=int, default=SWEEPS, metavar="N", help=f"most files of a folder ({SWEEPS})")
    parser.add_argument("--share", type=int, default=1, metavar="N", help="every Nth case, which its name chooses")
    parser.add_argument("--data", action="append", metavar="FOLDER", help="measurements beside data/, as often as wanted; "
                        "else LYREFIT_FIELD_DATA of the environment")
    parser.add_argument("--corpus", nargs="*", choices=KINDS, metavar="KIND", help="the corpus of made cases instead, all kinds or "
                        "these: " + ", ".join(KINDS))
    parser.add_argument("--rounding", type=float, metavar="R", help="numbers that agree within this relative difference are told apart "
                        "from differences (cmake/same/rounding.py)")
    parser.add_argument("--verb", action="append", metavar="NAME", help="cases of this verb alone, as often as wanted")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="cases at once (all processors)")
    parser.add_argument("--limit", type=float, metavar="SECONDS", help="of a case with one build (60, with --full 1200)")
    parser.add_argument("--allow", type=pathlib.Path, metavar="FILE", help="accepted differences: a case's name and the reason a line")
    parser.add_argument("--list", action="store_true", help="print the cases and stop")
    parser.add_argument("--unmasked", action="store_true", help="compare durations too, to see what differs from run to run")
    given = parser.parse_args()
    if not given.list:
        for binary in (given.old,) if given.sanitized else (given.old, given.new):
            if binary is None or not os.access(binary, os.X_OK):
                parser.error(f"expected {'a build' if given.sanitized else 'two builds'} of the command, found {binary}")
    return given


def main():
    given = arguments()
    field = os.environ.get("LYREFIT_FIELD_DATA")
    links = links_of([ROOT / "data", *(given.data or ([field] if field else []))])
    if given.corpus is None:
        cases = all_cases(ROOT, links, None if given.full else given.sweeps)
    else:
        cases = corpus_cases(given.corpus)
    if given.sanitized:  # which are slow: the commands of pages run on many curves
        cases = [case for case in cases if case.verb != "pages"]
    cases = [case for case in cases if zlib.crc32(case.name.encode()) % given.share == 0]
    if given.verb:
        cases = [case for case in cases if any(case.name.startswith(verb + "/") for verb in given.verb)]
    if given.list:
        print(*(f"{case.name}\t{case.shown()}" for case in cases), sep="\n")
        return 0
    if not cases:
        sys.exit("no case is left")
    old, new = given.old.resolve(), None if given.sanitized else given.new.resolve()
    reasons = accepted(given.allow)
    begin = time.monotonic()
    said = [begin]

    def tell(text):
        if sys.stderr.isatty() or time.monotonic() - said[0] > 60:
            said[0] = time.monotonic()
            print(text, end="\r" if sys.stderr.isatty() else "\n", file=sys.stderr, flush=True)

    with tempfile.TemporaryDirectory(prefix="lyrefit-same-") as work:
        results = compare(cases, old, new, links, pathlib.Path(work), jobs=given.jobs, masks=[] if given.unmasked else MASKS,
                          limit=given.limit or (1200 if given.full else 60), relative=given.rounding, tell=tell)
    code = report(results, reasons, old, new, links, given.rounding)
    if not given.verb and given.share == 1 and given.corpus is None:
        for name in flags_without_case(old, cases):
            print(f"no case gives {name}")
    print(f"{time.monotonic() - begin:.0f} s, {given.jobs} at once")
    return code


if __name__ == "__main__":
    sys.exit(main())
