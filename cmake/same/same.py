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
from running import MASKS, Runner, differences, faults

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


def compare(cases, old, new, links, work, *, jobs=1, limit=60.0, masks=MASKS, tell=lambda text: None):
    """(case, seconds of both, differences or None if both hit the limit) of each case, in the order of the cases. Cases
    that take longest run first. Without a new build: faults of the old one instead of differences."""
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
                found = differences(*outcomes, masks) if new else faults(*outcomes)
            results[number] = (cases[number], [outcome.seconds for outcome in outcomes], found)
            with lock:
                counts["done"] += 1
                counts["different"] += bool(found)
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
    parts += [f"printf %s {shlex.quote(text)} > {name}" for name, text in case.given]
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


def report(results, reasons, old, new, links):
    """Prints what was found; returns the exit code."""
    table = {}
    for case, seconds, found in results:
        row = table.setdefault(case.verb, [0] * 5 + [0.0, 0.0])
        row[0] += 1
        row[4 if found is None else 1 if not found else 3 if case.name in reasons else 2] += 1
        row[5] += seconds[0]
        row[6] += seconds[-1]
    for case, _, found in results:
        if found and case.name not in reasons:
            print(f"\n{'DIFFERENT' if new else 'FAULT'} {case.name}")
            for what, lines in found:
                print(f"  {what}", *(f"    {line}" for line in lines), sep="\n")
            print("  by hand:", *(f"    {by_hand(case, binary, links)}" for binary in (old, new) if binary), sep="\n")
    for case, _, found in results:
        if found and case.name in reasons:
            print(f"\naccepted {case.name}: {reasons[case.name]}\n  {case.shown()}")
            print(*(f"  {what}" for what, _ in found), sep="\n")
    for case, seconds, found in results:
        if found is None:
            print(f"\nNOT {'COMPARED, both' if new else 'JUDGED, it'} hit the limit: {case.name}\n  {case.shown()}")
    equal = {case.name for case, _, found in results if found == []}
    for name in reasons:
        if name in equal:
            print(f"\nno longer different: {name}")
    rows = [*table.items(), ("all", [sum(column) for column in zip(*table.values())] or [0] * 7)]
    if new:
        print(f"\n{'verb':12}{'cases':>7}{'same':>7}{'different':>11}{'accepted':>10}{'not compared':>14}{'s old':>9}{'s new':>9}")
    else:
        print(f"\n{'verb':12}{'cases':>7}{'clean':>7}{'faults':>11}{'accepted':>10}{'not judged':>14}{'s':>9}")
    for verb, row in rows:
        print(f"{verb:12}{row[0]:7}{row[1]:7}{row[2]:11}{row[3]:10}{row[4]:14}{row[5]:9.1f}" + (f"{row[6]:9.1f}" if new else ""))
    total = rows[-1][1]
    return DIFFERENT if total[2] else NOT_COMPARED if total[4] else 0


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
    cases = all_cases(ROOT, links, None if given.full else given.sweeps)
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
                          limit=given.limit or (1200 if given.full else 60), tell=tell)
    code = report(results, reasons, old, new, links)
    if not given.verb and given.share == 1:
        for name in flags_without_case(old, cases):
            print(f"no case gives {name}")
    print(f"{time.monotonic() - begin:.0f} s, {given.jobs} at once")
    return code


if __name__ == "__main__":
    sys.exit(main())
