"""Families, diagnoses, translations, certificates and comparisons: what the command writes, byte for byte."""

import json
import pathlib
import tempfile
import threading
import unittest
import _thread

import numpy as np
import pandas as pd

import lyrefit
from helpers import DATA, command, without_clocks

CELL = DATA / "rtc_france"
SHADED = DATA / "diagnosis" / "shaded_module.csv"
SWEEPS = DATA / "diagnosis" / "sweeps"
FAMILY = DATA / "s75_constructed"
DEVICE = {"Iph": 0.7608, "Is1": 3.1e-7, "n1": 1.477, "Rs": 0.0365, "Rsh": 52.9}


class Verbs(unittest.TestCase):
    def same(self, result, *arguments, code=0):
        self.assertEqual(without_clocks(command(*arguments, "--json", "-", code=code)), without_clocks(result.json))

    def test_family(self):
        joint = lyrefit.fit_family(FAMILY, family="desoto", folds=0, individual_fits=False, search_curves=4, seed=3)
        self.same(joint, "fit", FAMILY, "--family", "desoto", "--folds", 0, "--no-individual-fits", "--search-curves", 4,
                  "--seed", 3)
        self.assertEqual(len(joint.frame()), len(joint["curves"]))
        self.assertEqual(list(joint.parameter_frame()["parameter"]), list(joint.parameters))
        self.assertEqual(joint.pvlib["parameters"]["R_s"], joint.parameters["R_s"])
        self.assertIn("Rs", joint._repr_html_())
        with self.assertRaisesRegex(lyrefit.Error, "takes the law pvsyst"):
            print(joint.pan)
        quick = {"folds": 0, "individual_fits": False, "search_curves": 4, "fix": {"EgRef": 1.12}}
        pvsyst = lyrefit.fit_family(FAMILY, family="pvsyst", **quick)
        self.assertEqual(pvsyst.pan.splitlines()[0], "PVObject_=pvModule")
        free = lyrefit.fit_family(FAMILY, family="free", intervals=False)
        self.same(free, "fit", FAMILY, "--family", "free", "--intervals", "none")
        self.assertEqual(len(free.fit_frame()), len(free["curves"]))

    def test_data_sheet(self):
        sheet = {"v_mp": "30.3", "i_mp": "8.58", "v_oc": "37.8", "i_sc": "9.05", "alpha_sc": "0.06%",
                 "beta_voc": "-0.31%"}
        flags = ["--vmp", "30.3", "--imp", "8.58", "--voc", "37.8", "--isc", "9.05", "--alpha", "0.06%",
                 "--beta=-0.31%", "--cells", 60]
        found = lyrefit.fit_datasheet(**sheet, cells_in_series=60, gamma_pmp="-0.41", name="M")
        self.same(found, "datasheet", *flags, "--gamma=-0.41")
        self.assertEqual(found.text, command("datasheet", *flags, "--gamma=-0.41"))
        self.assertEqual(found.pvlib, json.loads(command("datasheet", *flags, "--name", "M", "--pvlib", "-")))
        self.assertTrue(found.usable)
        self.assertEqual(found["family"]["picked"]["n"], found.parameters["n"])
        with tempfile.TemporaryDirectory() as folder:
            found.save_plot(folder + "/family.svg")
            self.assertIn("picked", pathlib.Path(folder, "family.svg").read_text())
        numbers = [30.3, 8.58, 37.8, 9.05, 9.05 * 0.0006, -37.8 * 0.0031, 60]
        exact = lyrefit.fit_datasheet(*numbers)
        self.assertIsNone(exact["parameters"]["R_s"]["low"])
        self.assertLess(found["parameters"]["R_s"]["low"], exact.parameters["R_s"])
        for name, value in found.parameters.items():
            self.assertAlmostEqual(value, exact.parameters[name], delta=1e-9 * abs(value))
        for wrong, sentence in [({"i_sc": "much"}, "i_sc: expected a number, found 'much'"),
                                ({"beta_voc": None}, "beta_voc: expected a number"),
                                ({"cells_in_series": 0}, "cells_in_series: 0 is outside"),
                                ({"i_mp": 9.2}, "")]:
            with self.subTest(wrong), self.assertRaisesRegex(lyrefit.Error, sentence):
                lyrefit.fit_datasheet(**dict(sheet, cells_in_series=60) | wrong)

    def test_a_search_of_ones_own(self):
        """The fit goes on from its candidates; what it raises is raised."""
        seen = []

        def mine(objective, lower, upper, options):
            draws = np.random.default_rng(options["seed"]).uniform(lower, upper, (50, len(lower)))
            seen.append(draws)
            return draws[np.argsort(objective(draws))]

        fit = lyrefit.fit(CELL, searcher=mine, seed=3)
        self.assertEqual(fit["search"]["evaluations"], 50)
        self.assertIn(fit["parameters"]["photocurrent"]["searched"], seen[0])
        self.assertAlmostEqual(fit["rmse"]["refined"]["solved_current_A"],
                               lyrefit.fit(CELL)["rmse"]["refined"]["solved_current_A"], delta=1e-12)
        with self.assertRaises(ZeroDivisionError):
            lyrefit.fit(CELL, searcher=lambda *all: 1 / 0)
        for wrong in (lambda o, low, high, options: high * 10, lambda o, low, high, options: low * np.nan):
            with self.assertRaisesRegex(lyrefit.Error, "candidate is .*expected a number in"):
                lyrefit.fit(CELL, searcher=wrong)
            with self.assertRaisesRegex(lyrefit.Error, "<lambda> cannot be compared on .*expected a number in"):
                lyrefit.compare([CELL], models="sd", algorithms=["lo", wrong], runs=2, population=5, iterations=3)
        with self.assertRaisesRegex(lyrefit.Error, "searcher: expected a function"):
            lyrefit.fit(CELL, searcher="mlo")
        with self.assertRaisesRegex(lyrefit.Error, "are for fit"):
            lyrefit.fit_many([CELL], searcher=mine)

    def test_rmse_of_given_parameters_is_that_of_the_fit(self):
        for keywords in ({}, {"model": "td", "bounds": "literature"}, {"constants": "literature"}):
            fit = lyrefit.fit(DATA / "rtc_france", intervals="none", **keywords)
            constants = {"constants": keywords["constants"]} if "constants" in keywords else {}
            for curve in (DATA / "rtc_france", fit.curve, fit):
                for parameters in (fit, fit.parameters):
                    self.assertEqual(lyrefit.rmse(curve, parameters, **constants), fit["rmse"]["refined"])
        single = lyrefit.fit(DATA / "rtc_france", intervals="none")
        pvlib = dict(single.parameters, nNsVth=single["nNsVth"])
        del pvlib["n"]
        expected = single["rmse"]["refined"]
        for name, value in lyrefit.rmse((single.curve.voltage, single.curve.current), pvlib, temperature_C=33,
                                        cells_in_series=1).items():
            self.assertAlmostEqual(value, expected[name], delta=1e-12)
        for wrong, sentence in [({"Iph": 0.76}, "no value for Is1"), (3, "expected a mapping or a fit"),
                                (dict(single.parameters, nNsVth=0.04), "n and nNsVth say the same"),
                                (dict(single.parameters, n="much"), "n: expected a number, found 'much'"),
                                (lyrefit.certify(DATA / "rtc_france", models="sd"), "expected a mapping or a fit")]:
            with self.subTest(sentence), self.assertRaisesRegex(lyrefit.Error, sentence):
                lyrefit.rmse(DATA / "rtc_france", wrong)
        with self.assertRaisesRegex(TypeError, "no keyword 'constant'"):
            lyrefit.rmse(DATA / "rtc_france", single, constant="codata")

    def test_audit(self):
        with tempfile.TemporaryDirectory() as folder:
            rows = pathlib.Path(folder) / "rows.csv"
            rows.write_text("source,device,model,algorithm,rmse_A,Iph_A,Rs_ohm,Rsh_ohm,Is1_A,n1\n"
                            "T,rtc_france,sd,coarse,9E-04,,,,,\n"
                            "T,rtc_france,sd,right,9.8602E-04,0.760776,0.036377,53.7185,3.23021e-7,1.481184\n")
            audit = lyrefit.audit(rows, curves=[DATA])
            self.same(audit, "audit", rows, "--curves", DATA)
            self.assertEqual(audit.text, command("audit", rows, "--curves", DATA))
            coarse, right = audit["findings"]
            self.assertIn("9.860219e-04 A, cut off to the claim's digits", coarse["sentence"])
            self.assertEqual(list(audit.frame()["verdict"]), [coarse["verdict"], right["verdict"]])
            self.assertEqual(right["verdict"], "reproduces")
            with self.assertRaisesRegex(lyrefit.Error, "nowhere"):
                lyrefit.audit(rows, curves="nowhere")
        with self.assertRaisesRegex(lyrefit.Error, "nosuch.csv: the file does not exist"):
            lyrefit.audit("nosuch.csv")

    def test_bounds_beside_a_curve_that_does_not_exist(self):
        with self.assertRaisesRegex(lyrefit.Error, "nosuch: the file does not exist"):
            lyrefit.fit("nosuch", bounds="literature")

    def test_family_of_a_long_frame(self):
        curves = []
        for light in (400, 700, 1000):
            device = dict(DEVICE, Iph=0.7608 * light / 1000)
            one = lyrefit.simulate(device, irradiance_Wm2=light, temperature_C=33, points=25).frame()
            curves.append(one.assign(curve=f"at {light}", irradiance=light, temperature=33.0))
        keywords = dict(folds=0, individual_fits=False, fix={"R_sh_ref": 52.9}, shunt="constant")
        of_frame = lyrefit.fit_family(pd.concat(curves), **keywords)
        self.assertEqual(list(of_frame.frame()["id"]), ["at 400", "at 700", "at 1000"])
        self.assertAlmostEqual(of_frame.parameters["R_s"], 0.0365, delta=1e-6)
        of_list = lyrefit.fit_family(
            {c["curve"].iloc[0]: lyrefit.Curve(c, irradiance_Wm2=c["irradiance"].iloc[0], temperature_C=33.0)
             for c in curves}, **keywords)
        self.assertEqual(of_frame.parameters, of_list.parameters)

    def test_diagnose(self):
        found = lyrefit.diagnose(SHADED, held_out=False)
        self.same(found, "diagnose", SHADED, "--no-held-out")
        self.assertEqual(found.causes, ["shading"])
        self.assertIn("partial shading", found.sentence)
        self.assertEqual(len(found.frame()), len(found["trials"]))
        self.assertEqual(list(found.cause_frame()["id" if "id" in found.cause_frame() else "cause"]), ["shading"])
        self.assertIsNone(found.extended)

    def test_diagnose_against_reference_sweeps(self):
        now = DATA / "diagnosis" / "sweep_now.csv"
        options = dict(held_out=False)
        found = lyrefit.diagnose(now, reference=SWEEPS, **options)
        self.same(found, "diagnose", now, "--reference", SWEEPS, "--no-held-out")
        files = sorted(SWEEPS.glob("*.csv"))
        if len(files) > 4:
            one_by_one = lyrefit.diagnose(now, reference=files, **options)
            self.assertEqual(one_by_one.causes, found.causes)
        outlier = lyrefit.diagnose(SWEEPS, module=True)
        self.same(outlier, "diagnose", SWEEPS, "--module")
        self.assertGreater(len(outlier.frame()), 4)

    def test_translate(self):
        options = dict(procedures=["iec1", "desoto"], alpha="0.05%", draws=2000, seed=4, tracer="one")
        found = lyrefit.translate(SHADED, to=(900, 40), **options)
        self.same(found, "translate", SHADED, "--to", "900,40", "--procedures", "iec1,desoto", "--alpha", "0.05%",
                  "--draws", 2000, "--seed", 4, "--tracer", "one")
        self.assertEqual(list(found.frame()["procedure"])[:1], ["iec1"])
        self.assertIn(found.recommended["procedure"], ("iec1", "desoto"))

    def test_cell(self):
        pair = lyrefit.cell(DATA / "cell" / "pair.csv", hysteresis=2)
        self.same(pair, "cell", DATA / "cell" / "pair.csv", "--hysteresis", 2)
        files = [DATA / "cell" / name for name in ("suns.csv", "lit_dark.csv")]
        traced = lyrefit.cell(files, fit=False, area_cm2=0.2)
        self.same(traced, "cell", *files, "--no-fit", "--area-cm2", 0.2)
        self.assertEqual(len(traced.frame()), len(traced["sweeps"]))
        self.assertEqual(list(pair.frame()["direction"]), ["reverse", "forward"])
        with tempfile.TemporaryDirectory() as folder:
            pair.save_plot(folder + "/cell.svg")
            self.assertIn("</svg>", pathlib.Path(folder, "cell.svg").read_text())
        voltage = np.linspace(-0.1, 0.7, 81)
        dark = 1e-12 * np.expm1(voltage / 0.0257)
        arrays = lyrefit.cell({"lit": lyrefit.Curve(voltage, 5e-3 - dark, temperature_C=25),
                               "dark": lyrefit.Curve(voltage, -dark, temperature_C=25, irradiance_Wm2=0)},
                              area_cm2=0.25, fit=False)
        self.assertAlmostEqual(arrays["sweeps"][0]["jsc_mA_cm2"], 20, places=6)
        self.assertFalse(arrays["superposition"]["departs"])
        alone = lyrefit.cell(voltage, 5e-3 - dark, area_cm2=0.25, fit=False)
        self.assertEqual(alone["sweeps"][0]["efficiency"], arrays["sweeps"][0]["efficiency"])

    def test_two_junctions(self):
        """A tandem is simulated, fitted and simulated again."""
        device = {"Is1": 1e-14, "n1": 1.4, "Rsh1": 3000, "Is2": 3e-10, "n2": 1.2, "Rsh2": 1500, "Rs": 2}
        sets = [text for name, value in device.items() for text in ("--set", f"{name}={value}")]
        tandem = lyrefit.simulate({**device, "Iph1": 0.0195, "Iph2": 0.0202}, junctions=2, points=60)
        self.assertEqual(tandem.csv, command("simulate", "--junctions", 2, *sets, "--set", "Iph1=0.0195", "--set",
                                             "Iph2=0.0202", "--points", 60))
        red = lyrefit.simulate({**device, "Iph1": 0.0195, "Iph2": 0.0101}, junctions=2, points=60)
        with tempfile.TemporaryDirectory() as folder:
            files = [pathlib.Path(folder, name) for name in ("white.csv", "red.csv")]
            for file, curve in zip(files, (tandem, red)):
                file.write_text(curve.csv)
            found = lyrefit.fit(files, junctions=2, light={"white": (1, 1), "red": (1, 0.5)}, intervals="symmetric")
            self.same(found, "fit", *files, "--junctions", 2, "--light", "white=1:1", "--light", "red=1:0.5",
                      "--intervals", "symmetric")
        self.assertTrue(found.usable)
        self.assertAlmostEqual(found.parameters["n_1"], 1.4, places=3)
        again = lyrefit.simulate(found, curve_id="white", voltage=tandem.voltage)
        np.testing.assert_allclose(again.current, tandem.current, atol=1e-7)
        arrays = lyrefit.fit({"white": tandem, "red": red}, junctions=2, light={"white": (1, 1), "red": (1, 0.5)},
                             intervals="symmetric")
        self.assertAlmostEqual(arrays.parameters["n_2"], found.parameters["n_2"], places=6)
        with self.assertRaisesRegex(lyrefit.Error, "needs junctions=2"):
            lyrefit.fit(CELL, light={"rtc_france": (1, 1)})
        with self.assertRaisesRegex(lyrefit.Error, "model is for one junction"):
            lyrefit.fit(CELL, junctions=2, model="dd")

    def test_certify(self):
        found = lyrefit.certify(CELL, models=["sd", "dd"], n_upper=2.5)
        self.same(found, "certify", CELL, "--models", "sd,dd", "--n-upper", 2.5)
        self.assertTrue(found.certified)
        self.assertEqual(list(found.frame()["model"]), ["floor", "sd", "dd"])
        curve = lyrefit.read_curve(CELL)
        arrays = lyrefit.certify(curve.voltage, curve.current, temperature_C=33, models="sd")
        self.assertEqual(arrays["floor"]["rmse_A"], lyrefit.certify(CELL, models="sd")["floor"]["rmse_A"])

    def test_compare(self):
        small = dict(models="sd", runs=4, population=10, iterations=10)
        flags = ["--models", "sd", "--runs", 4, "--population", 10, "--iterations", 10]
        found = lyrefit.compare(CELL, algorithms=["mlo", "random"], bounds="paper", **small)
        self.same(found, "compare", CELL, "--algorithms", "mlo,random", "--bounds", "paper", *flags)
        self.assertEqual(list(found.frame()["algorithm"]), ["mlo", "random"])
        self.assertEqual(len(found.run_frame()), 8)

        def mine(objective, lower, upper, options):
            random = np.random.default_rng([options["seed"], options["run"]])
            points = lower + (upper - lower) * random.random((options["population"] * options["iterations"], len(lower)))
            return points[np.argsort(objective(points), kind="stable")[:4]]

        twice = [lyrefit.compare(CELL, algorithms=["mlo", {"mine": mine}], **small) for _ in range(2)]
        self.assertEqual(*(without_clocks(one.json) for one in twice))
        own = twice[0].frame().set_index("algorithm").loc["mine"]
        self.assertEqual(own["evaluations"], 100)
        self.assertEqual(own["within_1e9"], 4)

        def broken(objective, lower, upper, options):
            return objective(lower[:-1])

        with self.assertRaisesRegex(lyrefit.Error, "the objective takes arrays"):
            lyrefit.compare(CELL, algorithms=broken, **small)
        with self.assertRaisesRegex(ValueError, "best point"):
            lyrefit.compare(CELL, algorithms=lambda *all: 3.0, **small)

    def test_same_sentences(self):
        """A mistake is said in the words of the command."""
        for call, arguments in (
            (lambda: lyrefit.diagnose("nowhere.csv"), ["diagnose", "nowhere.csv"]),
            (lambda: lyrefit.certify("nowhere.csv"), ["certify", "nowhere.csv"]),
            (lambda: lyrefit.fit_family(CELL), ["fit", CELL, "--family", "desoto"]),
            (lambda: lyrefit.translate(SHADED, rated_W=-3), ["translate", SHADED, "--rated-W", "-3"]),
        ):
            with self.assertRaises(lyrefit.Error) as raised:
                call()
            said = command(*arguments, code=1).replace("--rated-W", "rated_W")  # of a flag, of a keyword
            self.assertIn(raised.exception.message, said)
        with self.assertRaisesRegex(TypeError, "did you mean 'probability'"):
            lyrefit.diagnose(SHADED, probabilty=0.9)
        with self.assertRaisesRegex(lyrefit.Error, "healthy and module"):
            lyrefit.diagnose(SHADED, reference=SWEEPS, module=True)

    def test_progress_and_interrupt(self):
        heard = []
        lyrefit.compare(CELL, models="sd", runs=3, population=10, iterations=10, progress=heard.append)
        self.assertIsInstance(heard[0], lyrefit.Progress)
        begun = threading.Event()

        def interrupt():
            begun.wait()
            _thread.interrupt_main()

        threading.Thread(target=interrupt, daemon=True).start()
        with self.assertRaises(KeyboardInterrupt):
            lyrefit.compare(CELL, runs=100000, threads=1, progress=lambda progress: begun.set())


if __name__ == "__main__":
    unittest.main()
