"""Tests of four_modes.py on simulated years with perfect instruments."""

import csv
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import unittest

import four_modes

MODES = four_modes.FIGURES[:4]


class FourModes(unittest.TestCase):
    def weeks(self, effects):
        """The figures of six weeks, and the truth."""
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, "--out", folder, "--effects", effects, "--days", "42", "--minutes", "60",
                            "--perfect", "1"], check=True)
            out = pathlib.Path(folder) / "modes.csv"
            subprocess.run([sys.executable, four_modes.__file__, pathlib.Path(folder) / "year0001.csv",
                            "--out", out], check=True)
            with open(out, newline="", encoding="utf-8") as file:
                weeks = list(csv.DictReader(file))
            truth = json.loads((pathlib.Path(folder) / "year0001.truth.json").read_text())
        self.assertEqual([week["week"] for week in weeks[:2]], ["2025-01-01", "2025-01-08"])
        return [{key: float(week[key]) for key in four_modes.FIGURES} for week in weeks], truth

    def late(self, effects):
        """Medians of the last three weeks, of which the first of the year know nothing."""
        weeks = self.weeks(effects)[0][3:]
        return {key: statistics.median(week[key] for week in weeks) for key in four_modes.FIGURES}

    def test_clean_module_loses_by_its_first_resistance_alone(self):
        modes = self.late("none")
        self.assertLess(modes["resistance_series_W"], -10)  # against a module without resistance
        for mode in ("uniform_current_W", "recombination_W", "mismatch_W"):
            self.assertAlmostEqual(modes[mode], 0, delta=3)

    def test_each_change_shows_in_its_mode(self):
        clean = self.late("none")
        for effects, mode in (("bypass=21", "recombination_W"), ("series=400", "resistance_series_W")):
            modes = self.late(effects)
            change = {key: modes[key] - clean[key] for key in MODES}
            self.assertEqual(min(change, key=change.get), mode, effects)
            self.assertLess(change[mode], -4, effects)

    def test_dust_is_uniform_current(self):
        clean, _ = self.weeks("none")
        dusty, truth = self.weeks("soiling=0.3")
        energy, light = truth["daily"]["undamaged_Wh"], truth["daily"]["light"]

        def mean(days):
            return sum(energy[day] * light[day] for day in days) / sum(energy[day] for day in days)

        for number, (without, with_dust) in enumerate(zip(clean, dusty)):
            share = mean(range(7 * number, 7 * number + 7)) / mean(range(21)) - 1
            change = with_dust["uniform_current_W"] - without["uniform_current_W"]
            self.assertAlmostEqual(change, share * with_dust["pseudo_p_mp_W"], delta=2)

    def test_modes_add_up_to_the_change_of_power(self):
        for week in self.weeks("standard")[0]:
            self.assertAlmostEqual(sum(week[mode] for mode in MODES), week["p_mp_W"] - week["pseudo_p_mp_W"],
                                   delta=1e-3)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
