"""Parameters as reports name them: of fits and families with their symbols and units, of effects with theirs."""

import json
import pathlib
import re
import subprocess
import tempfile

from comparison import Entry

# A report for each set of names; small searches suffice, since names do not depend on the answer.
SMALL = ["--population", "10", "--iterations", "10", "--intervals", "none", "--quiet"]
REPORTS = {
    "fit": ["fit", "data/rtc_france", "--model", "td", *SMALL],
    **{f"family {law}": ["fit", "data/s75_constructed", "--family", law, "--no-individual-fits", *SMALL]
       for law in ("desoto", "pvsyst", "cec")},
}


def of_report(name, report):
    """The entries of a report's parameters: key, symbol and unit."""
    return {f"{name}: parameters.{key}": Entry("exact", f"{p['symbol']} [{p['unit']}]")
            for key, p in report["parameters"].items()}


def of_explanation(effect, text):
    """The entries of an effect's parameters, from the table of `diagnose --explain`."""
    table = re.search(r"^  parameter +bounds.*\n((?:  .*\n)+?)(?=  Bounds are|\Z)", text, flags=re.MULTILINE)
    rows = []
    for line in table.group(1).splitlines() if table else []:
        if re.match(r"  \S", line):
            rows.append(line.strip())
        elif rows:
            rows[-1] += " " + line.strip()
    entries = {}
    for row in rows:
        symbol, _, meaning = re.split(r" {2,}", row, maxsplit=2)
        unit = re.search(r" \(([^() ]{1,12})\)$", meaning)
        entries[f"effect: {effect}.{symbol}"] = Entry("exact", f"{meaning.split(',')[0]} [{unit.group(1) if unit else ''}]")
    return entries


def reported(command, root):
    """The entries of all reports and effects of the command."""
    entries = {}
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "report.json"
        for name, arguments in REPORTS.items():
            run = subprocess.run([command, *arguments, "--json", file], cwd=root, capture_output=True, text=True)
            if run.returncode not in (0, 2):  # 2: not usable, after so small a search
                raise RuntimeError(run.stderr)
            entries.update(of_report(name, json.loads(file.read_text(encoding="utf-8"))))
            file.unlink()

    def said(*arguments):
        return subprocess.run([command, *arguments], check=True, capture_output=True, text=True).stdout

    effects = re.search(r"'diagnose --explain'\) words='([^']*)'", said("completion", "bash")).group(1).split()
    for effect in effects:
        entries.update(of_explanation(effect, said("diagnose", "--explain", effect)))
    return entries
