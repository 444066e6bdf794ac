"""What the module gives is what the command writes, byte for byte; only clocks differ."""

import pathlib
import tempfile
import unittest

import numpy as np

import lyrefit
from helpers import DATA, command, without_clocks


class Equality(unittest.TestCase):
    def check(self, file, flags, **keywords):
        written = command("fit", file, *flags, "--json", "-")
        with self.subTest(file=str(file), flags=flags):
            self.assertEqual(without_clocks(written), without_clocks(lyrefit.fit(file, **keywords).json))

    def test_fits(self):
        cell = DATA / "rtc_france"
        self.check(cell, [])
        self.check(cell, ["--bounds", "paper", "--seed", 7, "--algorithm", "de", "--run", 2],
                   bounds="paper", seed=7, algorithm="de", run=2)
        self.check(cell, ["--model", "dd", "--fix", "n2=2", "--bound", "Rs=0:0.1"],
                   model="dd", fix={"n2": 2}, bound={"Rs": (0, 0.1)})
        self.check(cell, ["--no-polish", "--objective", "measured-current", "--constants", "paper"],
                   polish=False, objective="measured-current", constants="paper")
        self.check(cell, ["--floor", "--intervals", "none", "--population", 12], floor=True, intervals="none",
                   population=12)
        self.check(DATA / "pwp201", ["--model", "auto", "--noise", "field"], model="auto", noise="field")
        self.check(DATA / "stm6_40_36", ["--loss", "huber", "--loss-scale", 2.5], loss="huber", loss_scale=2.5)
        self.check(DATA / "formats" / "density.txt", ["--area-cm2", 4, "--temperature-C", 25.5, "--cells", 1],
                   area_cm2=4, temperature_C=25.5, cells_in_series=1)
        self.check(DATA / "pwp201", ["--with", "nonohmic_shunt:m=2", "--with", "rs_current"],
                   with_=[{"nonohmic_shunt": {"m": 2}}, "rs_current"])

    def test_arrays_are_the_file(self):
        """From arrays comes the same answer; only where it was read from is another."""
        curve = lyrefit.read_curve(DATA / "pwp201")
        from_file = lyrefit.fit(DATA / "pwp201").to_dict()
        from_arrays = lyrefit.fit(curve.voltage, curve.current, cells_in_series=curve.cells_in_series,
                                  temperature_C=curve.temperature_C, irradiance_Wm2=curve.irradiance_Wm2).to_dict()
        for key in ("parameters", "rmse", "key_points", "information", "residuals", "data", "errors"):
            self.assertEqual(from_file[key], from_arrays[key], key)

    def test_many_are_one_by_one(self):
        files = [str(DATA / name) for name in ("rtc_france", "pwp201", "stp6_120_36")]
        together = lyrefit.fit_many(files, threads=3, seed=5)
        alone = lyrefit.fit_many(files, threads=1, seed=5)
        self.assertEqual(without_clocks(together.json), without_clocks(alone.json))
        self.assertEqual(without_clocks(together.json),
                         without_clocks(command("fit", *files, "--seed", 5, "--json", "-")))
        self.assertEqual(together.csv, command("fit", *files, "--seed", 5, "--csv", "-"))
        for i, file in enumerate(files):
            self.assertEqual(without_clocks(together[i].json), without_clocks(lyrefit.fit(file, seed=5, threads=1).json))

    def test_texts(self):
        result = lyrefit.fit(DATA / "rtc_france")
        self.assertIn("0.0365469", result.text)
        self.assertEqual(result.brief, command("fit", DATA / "rtc_france", "--brief"))
        self.assertTrue(result._repr_html_().lstrip().startswith("<!DOCTYPE html>"))

    def test_simulations(self):
        device = {"Iph": 0.7608, "Is1": 3.1e-7, "n1": 1.477, "Rs": 0.0365, "Rsh": 52.9}
        sets = [text for name, value in device.items() for text in ("--set", f"{name}={value}")]
        noisy = ["--temperature-C", 33, "--noise-A", 1e-3, "--noise-relative", 0.01, "--seed", 4]
        self.assertEqual(command("simulate", *sets, *noisy, "--points", 20),
                         lyrefit.simulate(device, temperature_C=33, noise_A=1e-3, noise_relative=0.01, seed=4,
                                          points=20).csv)
        named = lyrefit.simulate(photocurrent=0.7608, saturation_current=3.1e-7, n=1.477, resistance_series=0.0365,
                                 resistance_shunt=52.9, voltage=0.6 * np.arange(50) / 49)
        self.assertEqual(command("simulate", *sets, "--voltages", "0:0.6:50"), named.csv)
        for module in (DATA / "datasheet" / "invented.PAN", f"{DATA}/datasheet/invented_cec.csv#Invented I-304 M60"):
            at = ["--irradiance-Wm2", 800, "--temperature-C", 45, "--points", 20]
            self.assertEqual(command("simulate", "--from", module, *at),
                             lyrefit.simulate(module, irradiance_Wm2=800, temperature_C=45, points=20).csv)
        with tempfile.TemporaryDirectory() as folder, self.assertWarnsRegex(UserWarning, "The model of other.PAN gives"):
            other = pathlib.Path(folder) / "other.PAN"
            other.write_text((DATA / "datasheet" / "invented.PAN").read_text().replace("RSerie=0.218", "RSerie=0.4"))
            lyrefit.simulate(other)
        fitted = lyrefit.fit(DATA / "rtc_france")
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            file.write(fitted.json)
            file.flush()
            written = command("simulate", "--from", file.name, "--with", "nonohmic_shunt:k=0.002,m=2.5")
            from_file = lyrefit.simulate(file.name, with_="nonohmic_shunt:k=0.002,m=2.5")
        self.assertEqual(written, from_file.csv)
        self.assertEqual(written, lyrefit.simulate(fitted, with_={"nonohmic_shunt": {"k": 0.002, "m": 2.5}}).csv)


if __name__ == "__main__":
    unittest.main()
