"""Tests of score_years.py: reports made from the truths of a folder of simulated years."""

import copy
import datetime
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import score_years


def figure(value, half):
    return {"value": value, "low_95": value - half, "high_95": value + half}


def faithful(truth, half=0.01):
    """The report that knows the truth."""
    report = {"quantities": [], "onsets": [], "loss": {"energy_percent": {}}}
    for quantity in truth["quantities"]:
        claim = {"name": quantity["name"], "unit": quantity["unit"], "steps": []}
        if quantity["rate_per_year"] is not None:
            claim["rate_per_year"] = figure(quantity["rate_per_year"], half * quantity["at_start"])
        claim["steps"] = [{"date": step["date"], "size": figure(step["size"], half)} for step in quantity["steps"]]
        report["quantities"].append(claim)
    for onset in truth["onsets"]:
        report["onsets"].append(
            {"date": onset["date"], "quantity": onset["quantities"][0], "cause": onset["cause"]})
    for part, value in truth["loss"]["energy_percent"].items():
        report["loss"]["energy_percent"][part] = figure(value, half)
    return report


def moved(date, days):
    return (datetime.date.fromisoformat(date) + datetime.timedelta(days)).isoformat()


class ScoreYears(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        made = [PROGRAM, "--out", cls.folder.name, "--days", "300", "--minutes", "360", "--years", "2"]
        subprocess.run([*made, "--effects", "soiling,bypass=60,series=3,step=0.1,pid=150"], check=True)
        subprocess.run([*made, "--effects", "none", "--first-seed", "3"], check=True)
        cls.truths = {}
        for path in sorted(pathlib.Path(cls.folder.name).glob("*.truth.json")):
            cls.truths[path.name.removesuffix(".truth.json")] = json.loads(path.read_text())

    def scored(self, change):
        pairs = []
        for name, truth in self.truths.items():
            report = faithful(truth)
            change(truth, report)
            pairs.append((name, truth, copy.deepcopy(report)))
        return score_years.summary(score_years.score(pairs, 10, 0.3))

    def test_truth_scores_full_marks(self):
        tree = self.scored(lambda truth, report: None)
        for entry in tree["rates"].values():
            self.assertEqual(entry["holds"]["hits"], entry["modules"])
        for cause in ("all", "bypass_short", "series_step", "pid"):
            self.assertEqual(tree["onsets"][cause]["named"]["hits"], 6 if cause == "all" else 2)
        self.assertEqual(tree["false"]["count"], 0)
        self.assertEqual(tree["step_sizes"], {"hits": 2, "count": 2})
        for entry in tree["loss"].values():
            self.assertEqual(entry["within"]["hits"], 4)
            self.assertEqual(entry["holds"]["hits"], 4)
            self.assertLess(entry["rms"], 1e-9)

    def test_silence_is_never_right(self):
        tree = self.scored(lambda truth, report: report.clear())
        self.assertEqual(tree["onsets"]["all"]["found"]["hits"], 0)
        self.assertTrue(all(entry["stated"] == 0 for entry in tree["rates"].values()))
        self.assertTrue(all(entry["stated"] == 0 for entry in tree["loss"].values()))

    def test_late_onsets_are_not_found(self):
        def late(truth, report):
            report["quantities"] = []
            for onset in report["onsets"]:
                onset["date"] = moved(onset["date"], 11)

        tree = self.scored(late)
        self.assertEqual(tree["onsets"]["all"]["found"]["hits"], 0)
        # Late claims of steps are false; that of the gradual damage is only late.
        self.assertEqual(tree["false"]["by_quantity"], {"mismatch": 2})

    def test_onsets_of_clean_years_are_false(self):
        def invent(truth, report):
            report["onsets"].append({"date": "2025-05-10", "quantity": "resistance_shunt", "cause": "pid"})

        tree = self.scored(invent)
        self.assertEqual(tree["false_without_onset"]["count"], 2)
        self.assertEqual(tree["false"]["by_quantity"], {"resistance_shunt": 2 + 2})

    def test_narrow_intervals_miss(self):
        def shift(truth, report):
            report["loss"]["energy_percent"]["light"] = figure(
                truth["loss"]["energy_percent"]["light"] + 0.4, 0.1)
            report["quantities"][0]["rate_per_year"]["low_95"] = 1e3

        tree = self.scored(shift)
        self.assertEqual(tree["loss"]["light"]["within"]["hits"], 0)
        self.assertEqual(tree["loss"]["light"]["holds"]["hits"], 0)
        self.assertAlmostEqual(tree["loss"]["light"]["rms"], 0.4)
        self.assertEqual(tree["rates"]["resistance_series"]["holds"]["hits"], 0)

    def test_limits(self):
        low, high = score_years.wilson(95, 100)
        self.assertAlmostEqual(low, 0.8882, 4)
        self.assertAlmostEqual(high, 0.9785, 4)
        low, high = score_years.poisson(3)
        self.assertAlmostEqual(low, 0.6187, 3)
        self.assertAlmostEqual(high, 8.7673, 3)
        self.assertAlmostEqual(score_years.poisson(0)[1], 3.6889, 3)

    def test_command_prints_a_table(self):
        with tempfile.TemporaryDirectory() as reports:
            for name, truth in self.truths.items():
                (pathlib.Path(reports) / f"{name}.json").write_text(json.dumps(faithful(truth)))
            rows = pathlib.Path(reports) / "rows.csv"
            done = subprocess.run(
                [sys.executable, score_years.__file__, "--truth", self.folder.name, "--reports", reports,
                 "--rows", rows], check=True, capture_output=True, text=True)
            self.assertIn("resistance_series  4/4 = 100.0 %", done.stdout)
            self.assertIn("bypass_short       2/2 = 100.0 %", done.stdout)
            self.assertIn("rates,year0001,resistance_series", rows.read_text())


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
