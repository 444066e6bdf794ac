"""The example that writes NOMAD archives: its figures, their units, its page."""

import contextlib
import io
import json
import math
import os
import pathlib
import runpy
import tempfile
import unittest

import lyrefit

from helpers import ROOT

FIELD = os.environ.get("LYREFIT_FIELD_DATA", "")
LABORATORY = pathlib.Path(FIELD) / "../tracers/lab"
PAGE = (ROOT / "apps/python/examples/nomad.md").read_text(encoding="utf-8")


class Nomad(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        cls.enterClassContext(contextlib.chdir(folder))
        with contextlib.redirect_stdout(io.StringIO()):
            cls.example = runpy.run_path(str(ROOT / "apps/python/examples/nomad.py"))
        cls.record = cls.example["record"]
        cls.archive = json.loads(pathlib.Path("cell.archive.json").read_text())
        cls.analysis = json.loads(pathlib.Path("cell_diode.archive.json").read_text())

    def test_page_has_the_table(self):
        self.assertIn(self.example["table"], PAGE)

    def test_results_are_in_the_units_of_nomad(self):
        cell = self.archive["results"]["properties"]["optoelectronic"]["solar_cell"]
        lit = [sweep for sweep in self.record["sweeps"] if sweep["kind"] == "lit"]
        best = max(lit, key=lambda sweep: sweep["efficiency"])
        points = best["key_points"]
        self.assertAlmostEqual(cell["short_circuit_current_density"] * cell["device_area"],
                               points["short_circuit_current_A"], delta=1e-12)
        power_W = (cell["open_circuit_voltage"] * cell["short_circuit_current_density"] * cell["fill_factor"]
                   * cell["device_area"])
        self.assertAlmostEqual(power_W, points["max_power_W"], delta=1e-12)
        light_W = cell["illumination_intensity"] * cell["device_area"]
        self.assertAlmostEqual(cell["efficiency"], 100 * power_W / light_W, delta=1e-9)

    def test_plugin_keeps_the_curves(self):
        """Where `data_file` is set, nomad-hysprint reads the file anew and replaces the curves."""
        self.assertNotIn("data_file", self.archive["data"])
        self.assertIn("lit_dark.csv", self.archive["data"]["description"])

    def test_curves_are_read_back(self):
        """An archive is a file that lyrefit reads: the curves come back with area and light."""
        curves = self.archive["data"]["jv_curve"]
        self.assertEqual([curve["dark"] for curve in curves].count(True), 1)
        for place, curve in enumerate(curves, start=1):
            read = lyrefit.read_curve("cell.archive.json", curve_index=place)
            sweep = next(each for each in self.record["sweeps"] if each["name"] == curve["cell_name"])
            for voltage, current, there_V, there_A in zip(read.voltage, read.current, sweep["data"]["voltage_V"],
                                                          sweep["data"]["current_A"]):
                self.assertAlmostEqual(voltage, there_V, delta=1e-12)
                self.assertAlmostEqual(current, there_A, delta=1e-12)
            if not curve["dark"]:
                self.assertAlmostEqual(read.irradiance_Wm2, sweep["irradiance_Wm2"], delta=1e-9)

    def test_every_figure_is_defined_with_its_unit(self):
        quantities = self.analysis["definitions"]["sections"]["DiodeAnalysis"]["quantities"]
        data = dict(self.analysis["data"])
        self.assertEqual(data.pop("m_def"), "DiodeAnalysis")
        self.assertEqual(quantities.keys(), data.keys())
        for name, value in data.items():
            self.assertEqual(quantities[name].get("unit", ""), "ohm*cm**2" if "resistance" in name else "")
            self.assertTrue(math.isfinite(value))
        for name, truth in self.example["MADE_WITH"].items():
            if name + "_low_95" in data:
                self.assertAlmostEqual(data[name], truth, delta=0.03 * truth)

    @unittest.skipUnless(FIELD and LABORATORY.is_dir(), "needs the files of laboratories")
    def test_files_of_laboratories(self):
        example = self.example
        silicon = [LABORATORY / f"pvcm_{name}.json" for name in ("light", "dark", "suns_voc")]
        record = lyrefit.cell(silicon, area_cm2=165.34)
        hand = example["by_hand"](record, window_V=(0.5, 0.6), lights_A=(0.67, 6.7))
        self.assertIn(example["compared"](record, hand, {}), PAGE)
        self.assertNotIn("series_resistance", example["entry"](record)["data"]["jv_curve"][0])  # void
        stated = {"hydiris_six_pixels.jv.txt": ("b", 0.9547480140667368),
                  "kit_average_column.jv.csv": ("", 1.021169),
                  "hzb_names_then_units.txt": ("c", 1.202260), "hzb_new_format.jv.json": ("", 0.030763706927841555)}
        for name, (column, voc_V) in stated.items():
            with self.subTest(name):
                record = lyrefit.cell(LABORATORY / name, column=column)
                curves = example["entry"](record)["data"]["jv_curve"]
                found_V = [curve["open_circuit_voltage"] for curve in curves if not curve["dark"]]
                self.assertLess(min(abs(found / voc_V - 1) for found in found_V), 1e-3)
                self.assertEqual(len(found_V), 2)  # up and down
                self.assertEqual(len(curves), 4 if column == "b" else 2)  # with the dark ones


if __name__ == "__main__":
    unittest.main()
