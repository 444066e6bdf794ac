#!/usr/bin/env python3
"""Times of releases: the files are as their schema says, and a run is trimmed as the page says (data/speed)."""

import json
import pathlib
import re
import subprocess
import sys
import unittest

import jsonschema

ROOT = pathlib.Path(__file__).resolve().parents[2]
SPEED = ROOT / "data" / "speed"
sys.path.insert(0, str(ROOT / "tests" / "bench"))

import speed


def problems(record):
    schema = json.loads((SPEED / "schema.json").read_text(encoding="utf-8"))
    validator = jsonschema.Draft202012Validator(schema)
    return [error.message for error in validator.iter_errors(record)]


def repetition(name, cpu_time, **more):
    return {"name": name, "run_type": "iteration", "real_time": 2 * cpu_time, "cpu_time": cpu_time, "time_unit": "ms",
            **more}


class Files(unittest.TestCase):
    def test_every_release_is_as_the_schema_says(self):
        files = sorted(SPEED.glob("[0-9]*.json"))
        self.assertTrue(files)
        for file in files:
            with self.subTest(file.name):
                record = json.loads(file.read_text(encoding="utf-8"))
                self.assertEqual(problems(record), [])
                self.assertEqual(record["version"], file.stem)
                names = [row["name"] for row in record["benchmarks"]]
                self.assertEqual(len(names), len(set(names)))
                for row in record["benchmarks"]:
                    self.assertLessEqual(row.get("hits", 0), row.get("runs", 0))

    def test_the_schema_refuses_what_is_wrong(self):
        record = json.loads(next(iter(sorted(SPEED.glob("[0-9]*.json")))).read_text(encoding="utf-8"))
        record["benchmarks"][0]["cpu_time"] = 0
        record["machine"]["instructions"] = "MMX"
        self.assertEqual(len(problems(record)), 2)


class Commands(unittest.TestCase):
    def test_seconds_of_a_command_replace_those_before_and_leave_the_rest(self):
        record = {"version": "1.0.0", "commands": [{"name": "reference", "cpu_seconds": 1.0}, {"name": "check.sh", "cpu_seconds": 9.0}]}
        self.assertEqual(speed.with_command(record, "check.sh", 2345.678), {"version": "1.0.0", "commands": [
            {"name": "check.sh", "cpu_seconds": 2346.0}, {"name": "reference", "cpu_seconds": 1.0}]})

    def test_scripts_foretell_their_minutes_by_the_record_of_this_version(self):
        said = self.said("quickstart.sh --fit-only", "ReferenceSeconds() { Recorded reference; }; nproc() { echo 2; }")
        seconds = self.recorded("quickstart.sh --fit-only")
        self.assertIn(f"about {seconds / 2 / 60 + 0.5:.0f} minutes on the 2 processors", said)
        slower = self.said("quickstart.sh --fit-only", 'ReferenceSeconds() { awk -v s="$(Recorded reference)" "BEGIN { print 10 * s }"; }; nproc() { echo 1; }')
        self.assertIn(f"about {10 * seconds / 60 + 0.5:.0f} minutes on the 1 processors", slower)
        self.assertEqual(self.said("no such command", "ReferenceSeconds() { echo 1; }"), "")

    def test_what_newcomers_run_first_is_in_the_record(self):
        self.assertGreater(self.recorded("quickstart.sh --fit-only"), 60)  # no compiler's cache
        self.assertGreater(self.recorded("reference"), 0)

    @staticmethod
    def recorded(name):
        version = re.search(r"^project\(lyrefit VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.M)[1]
        record = json.loads((SPEED / f"{version}.json").read_text(encoding="utf-8"))
        return next(row["cpu_seconds"] for row in record["commands"] if row["name"] == name)

    @staticmethod
    def said(command, changes):
        script = f'source "{ROOT}/cmake/setup.sh"; {changes}; LYREFIT_COMMAND="{command}"; SayMinutes'
        return subprocess.run(["bash", "-euo", "pipefail", "-c", script], check=True, capture_output=True, text=True).stdout


class Trimming(unittest.TestCase):
    def test_a_benchmark_has_the_medians_of_its_repetitions_and_the_fewest_hits(self):
        run = {"benchmarks": [
            repetition("fit/iterations:50", 3.0, hits=50.0, runs=50.0),
            repetition("fit/iterations:50", 1.23456, hits=49.0, runs=50.0),
            repetition("fit/iterations:50", 1.0, hits=50.0, runs=50.0),
            {"name": "fit/iterations:50_mean", "run_type": "aggregate", "cpu_time": 9.0},
            repetition("failed", 1.0, error_occurred=True)]}
        self.assertEqual(list(speed.trimmed(run)), [
            {"name": "fit", "unit": "ms", "repetitions": 3, "real_time": 2.469, "cpu_time": 1.235, "hits": 49, "runs": 50}])

    def test_ratios_are_those_of_the_table(self):
        table = (
            "\nclaim                                                                  target   measured  met\n"
            "----------------------------------------------------------------------------------------------\n"
            "RTC France TD solved: NLopt CRS2+SLSQP, one setting for all / lyrefit      >= 2.00      20.80  yes  hits 20/20 : 50/50\n"
            "complete MLO run 100 x 1000, MSX-60 TD / its bare evaluations         <= 2.50       2.18  yes\n"
            "RTC France SD measured: with intervals / without                                   12.00     \n")
        self.assertEqual(list(speed.ratios(table)), [
            {"claim": "RTC France TD solved: NLopt CRS2+SLSQP, one setting for all / lyrefit", "ratio": 20.8, "target": 2.0},
            {"claim": "complete MLO run 100 x 1000, MSX-60 TD / its bare evaluations", "ratio": 2.18, "target": 2.5},
            {"claim": "RTC France SD measured: with intervals / without", "ratio": 12.0}])


if __name__ == "__main__":
    unittest.main()
