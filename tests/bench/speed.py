#!/usr/bin/env python3
"""The times of a release: what Google Benchmark wrote, trimmed to what stays (data/speed).

    speed.py BENCHMARK.json CLAIMS.txt --version X.Y.Z --compiler TEXT --out FILE [--shared]
    speed.py --out FILE --command NAME SECONDS

BENCHMARK.json is of `lyrefit_bench --benchmark_format=json --benchmark_repetitions=N`, CLAIMS.txt the table that it prints on
standard error. --shared says that other work ran on the machine. --command puts the processor seconds of one command into a
record that is there.
"""

import argparse
import json
import pathlib
import re
import statistics


def rounded(value):
    """Four digits, more than repetitions agree in."""
    return float(f"{value:.4g}")


def trimmed(run):
    """A benchmark each, with the medians of its repetitions."""
    repetitions = {}
    for row in run["benchmarks"]:
        if row.get("run_type") == "iteration" and not row.get("error_occurred"):
            repetitions.setdefault(re.sub(r"/iterations:\d+$", "", row["name"]), []).append(row)
    for name, rows in repetitions.items():
        kept = {"name": name, "unit": rows[0]["time_unit"], "repetitions": len(rows)}
        for time in ("real_time", "cpu_time"):
            kept[time] = rounded(statistics.median(row[time] for row in rows))
        for counter in ("hits", "runs"):
            if counter in rows[0]:
                kept[counter] = int(min(row[counter] for row in rows) if counter == "hits" else rows[0][counter])
        yield kept


def ratios(table):
    """The claims of a run: processor time of one benchmark over that of another."""
    row = re.compile(r"^(\S.*?) +(?:([<>]=) ([\d.]+) +)?([\d.]+)  (?:yes|NO| )")
    for line in table.splitlines():
        if found := row.match(line):
            claim, _, target, ratio = found.groups()
            kept = {"claim": claim.strip(), "ratio": float(ratio)}
            yield {**kept, "target": float(target)} if target else kept


def with_command(record, name, seconds):
    """The record with the processor seconds of a command, instead of those that it had."""
    others = [row for row in record.get("commands", []) if row["name"] != name]
    return {**record, "commands": sorted([*others, {"name": name, "cpu_seconds": rounded(seconds)}], key=lambda row: row["name"])}


def processor():
    """The processor's name and the widest instructions that the kernels know."""
    text = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
    flags = re.search(r"^flags\s*: (.*)$", text, flags=re.MULTILINE).group(1).split()
    widest = next((name for flag, name in (("avx512f", "AVX-512"), ("avx2", "AVX2")) if flag in flags), "SSE2")
    return re.search(r"^model name\s*: (.*)$", text, flags=re.MULTILINE).group(1), widest


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("benchmark", type=pathlib.Path, nargs="?")
    parser.add_argument("claims", type=pathlib.Path, nargs="?")
    parser.add_argument("--version")
    parser.add_argument("--compiler")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--shared", action="store_true")
    parser.add_argument("--command", nargs=2)
    given = parser.parse_args()
    before = json.loads(given.out.read_text(encoding="utf-8")) if given.out.exists() else {}
    if given.command:
        name, seconds = given.command
        given.out.write_text(json.dumps(with_command(before, name, float(seconds)), indent=1) + "\n", encoding="utf-8")
        print(f"{given.out}: {name}, {seconds} s of processor time")
        return
    run = json.loads(given.benchmark.read_text(encoding="utf-8"))
    name, widest = processor()
    rows = list(trimmed(run))
    context = run["context"]
    record = {
        "version": given.version,
        "date": context["date"][:10],
        "machine": {"processor": name, "instructions": widest, "processors": context["num_cpus"],
                    "clock_MHz": context["mhz_per_cpu"], "shared": given.shared},
        "compiler": given.compiler,
        "repetitions": max(row["repetitions"] for row in rows),
        "benchmarks": rows,
        "ratios": list(ratios(given.claims.read_text(encoding="utf-8"))),
    }
    if "commands" in before:
        record["commands"] = before["commands"]
    given.out.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
    print(f"{given.out}: {len(rows)} benchmarks, {len(record['ratios'])} ratios")


if __name__ == "__main__":
    main()
