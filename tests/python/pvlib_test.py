"""lyrefit.pvlib: pvlib's signatures, keys and types, and the equations behind them."""

import inspect
import io
import runpy
import unittest
from contextlib import redirect_stdout

import numpy as np
import pandas as pd

import lyrefit.pvlib as drop_in
from helpers import ROOT

KEYS = ["i_sc", "v_oc", "i_mp", "v_mp", "p_mp", "i_x", "i_xx"]
DEVICE = (8.0, 1e-10, 0.3, 300.0, 1.5)
DEVICES = ("photocurrent", "saturation_current", "resistance_series", "resistance_shunt", "nNsVth")


def excess(v, i, device):
    iph, isat, rs, rsh, a = device
    return iph - isat * np.expm1((v + i * rs) / a) - (v + i * rs) / rsh - i


class SignatureTest(unittest.TestCase):
    SIGNATURES = {
        "singlediode": [*DEVICES, ("ivcurve_pnts", None), ("method", "lambertw")],
        "i_from_v": ["voltage", *DEVICES, ("method", "lambertw")],
        "v_from_i": ["current", *DEVICES, ("method", "lambertw")],
        "max_power_point": [*DEVICES, ("d2mutau", 0), ("NsVbi", np.inf), ("method", "brentq")],
        "fit_desoto_sandia": ["ivcurves", "specs", ("const", None), ("maxiter", 5), ("eps1", 1e-3)],
        "fit_pvsyst_iec61853_sandia_2025": [
            "effective_irradiance", "temp_cell", "i_sc", "v_oc", "i_mp", "v_mp", "cells_in_series",
            ("EgRef", 1.121), ("alpha_sc", None), ("beta_mp", None), ("R_s", None),
            ("r_sh_coeff", 0.12), ("min_Rsh_irradiance", None), ("irradiance_tolerance", 20),
            ("temperature_tolerance", 1)],
        "fit_sandia_simple": ["voltage", "current", ("v_oc", None), ("i_sc", None),
                              ("v_mp_i_mp", None), ("vlim", 0.2), ("ilim", 0.1)],
    }

    def test_names_order_and_defaults_are_pvlibs(self):
        for name, expected in self.SIGNATURES.items():
            parameters = inspect.signature(getattr(drop_in, name)).parameters.values()
            found = [p.name if p.default is p.empty else (p.name, p.default) for p in parameters]
            self.assertEqual(found, expected, name)


class MatrixTest(unittest.TestCase):
    TRUTH = {"alpha_sc": 0.001, "gamma_ref": 1.0, "mu_gamma": -1e-4, "I_L_ref": 10.0,
             "I_o_ref": 1e-11, "R_sh_ref": 300.0, "R_sh_0": 1500.0, "R_sh_exp": 5.5, "R_s": 0.2,
             "cells_in_series": 60, "EgRef": 1.121}

    def matrix(self):
        """Key points by PVsyst's law, written down here once more."""
        p, k = self.TRUTH, 8.617333262e-5
        light = np.array([100, 100, 200, 400, 600, 600, 800, 1000, 1000, 1000, 1100.0])
        warm = np.array([15, 25, 25, 25, 25, 50, 50, 25, 50, 75, 75.0])
        kelvin, t0 = warm + 273.15, 298.15
        gamma = p["gamma_ref"] + p["mu_gamma"] * (warm - 25)
        isat = (p["I_o_ref"] * (kelvin / t0) ** 3
                * np.exp(p["EgRef"] / (k * gamma) * (1 / t0 - 1 / kelvin)))
        fade = np.exp(-p["R_sh_exp"])
        base = (p["R_sh_ref"] - p["R_sh_0"] * fade) / (1 - fade)
        rsh = base + (p["R_sh_0"] - base) * np.exp(-p["R_sh_exp"] * light / 1000)
        points = drop_in.singlediode(
            light / 1000 * (p["I_L_ref"] + p["alpha_sc"] * (warm - 25)), isat, p["R_s"], rsh,
            gamma * p["cells_in_series"] * k * kelvin)
        return light, warm, *(points[name].to_numpy() for name in ("i_sc", "v_oc", "i_mp", "v_mp"))

    def test_the_module_comes_back_also_with_gaps(self):
        matrix = self.matrix()
        found = drop_in.fit_pvsyst_iec61853_sandia_2025(*matrix, 60)
        self.assertEqual(list(found), list(self.TRUTH))
        for name, value in self.TRUTH.items():
            self.assertAlmostEqual(found[name] / value, 1, 4, name)
        matrix[4][3] = np.nan
        gaps = drop_in.fit_pvsyst_iec61853_sandia_2025(
            *(pd.Series(column) for column in matrix), 60, alpha_sc=0.001, R_s=0.2)
        self.assertEqual((gaps["alpha_sc"], gaps["R_s"]), (0.001, 0.2))
        self.assertAlmostEqual(gaps["gamma_ref"], 1, 4)

    def test_what_cannot_be_fitted_is_an_error(self):
        matrix = [column[:1] for column in self.matrix()]
        with self.assertRaisesRegex(ValueError, "at least two light curves"):
            drop_in.fit_pvsyst_iec61853_sandia_2025(*matrix, 60)


class SingleDiodeTest(unittest.TestCase):
    def test_numbers_give_a_dict_of_floats(self):
        points = drop_in.singlediode(*DEVICE)
        self.assertEqual(list(points), KEYS)
        self.assertTrue(all(type(value) is float for value in points.values()))
        for v, i in ((0, points["i_sc"]), (points["v_oc"], 0), (points["v_mp"], points["i_mp"]),
                     (points["v_oc"] / 2, points["i_x"]),
                     ((points["v_oc"] + points["v_mp"]) / 2, points["i_xx"])):
            self.assertLess(abs(excess(v, i, DEVICE)), 2e-13)
        beside = [v * drop_in.i_from_v(v, *DEVICE) for v in points["v_mp"] * np.array([1 - 1e-6, 1 + 1e-6])]
        self.assertLess(max(beside), points["p_mp"])

    def test_arrays_give_a_frame_and_a_series_its_index(self):
        light = pd.Series([2.0, 4.0, 8.0], index=["a", "b", "c"])
        frame = drop_in.singlediode(light, *DEVICE[1:])
        self.assertEqual(list(frame.columns), KEYS)
        self.assertEqual(list(frame.index), ["a", "b", "c"])
        self.assertEqual(frame.loc["c"].to_dict(), drop_in.singlediode(*DEVICE))
        self.assertEqual(list(drop_in.singlediode(light.to_numpy(), *DEVICE[1:]).index), [0, 1, 2])

    def test_points_of_curves(self):
        light = np.array([2.0, 8.0])
        for method, last in (("lambertw", -1), ("newton", -1)):
            curves = drop_in.singlediode(light, *DEVICE[1:], ivcurve_pnts=11, method=method)
            self.assertEqual(list(curves), KEYS + ["i", "v"])
            self.assertEqual((curves["i"].shape, curves["v_oc"].shape), ((2, 11), (2,)))
            self.assertLess(np.max(np.abs(excess(curves["v"][1], curves["i"][1], DEVICE))), 1e-12)
            self.assertAlmostEqual(curves["v"][1, last], curves["v_oc"][1], delta=1e-12)
        self.assertEqual(drop_in.singlediode(*DEVICE, 5)["v"].shape, (5,))

    def test_a_method_where_newer_versions_have_it(self):
        self.assertEqual(drop_in.singlediode(*DEVICE, "newton"), drop_in.singlediode(*DEVICE))
        with self.assertRaisesRegex(NotImplementedError, "expected one of lambertw.*found 'guess'"):
            drop_in.singlediode(*DEVICE, method="guess")

    def test_broadcasting_types_and_what_has_no_answer(self):
        voltage = np.linspace(-5, 40, 6).reshape(2, 3)
        current = drop_in.i_from_v(voltage, *DEVICE)
        self.assertEqual(current.shape, (2, 3))
        np.testing.assert_allclose(drop_in.v_from_i(current, *DEVICE), voltage, atol=1e-12)
        self.assertIs(type(drop_in.i_from_v(3, 8, 1e-10, 0.3, 300, 1.5)), float)
        self.assertTrue(np.isnan(drop_in.i_from_v(1.0, np.nan, *DEVICE[1:])))
        self.assertTrue(np.isnan(drop_in.v_from_i(9.0, 8.0, 1e-10, 0.3, np.inf, 1.5)))
        night = drop_in.singlediode(0.0, 1e-10, 0.3, np.inf, 1.5)
        self.assertEqual(set(night.values()), {0.0})

    def test_maximum_power_alone_and_of_thin_films(self):
        points = drop_in.singlediode(*DEVICE)
        self.assertEqual(dict(drop_in.max_power_point(*DEVICE)),
                         {key: points[key] for key in ("i_mp", "v_mp", "p_mp")})
        film = (1.3, 1e-9, 2.0, 700.0, 2.4)
        lossy = drop_in.max_power_point(*film, d2mutau=1.4, NsVbi=45.0)
        junction = lossy["v_mp"] + lossy["i_mp"] * film[2]
        lost = 1.3 * 1.4 / (45 - junction)
        self.assertLess(abs(excess(lossy["v_mp"], lossy["i_mp"], film) - lost), 1e-13)
        frame = drop_in.max_power_point(pd.Series([1.0, 2.0], index=[7, 9]), *DEVICE[1:])
        self.assertEqual(list(frame.index), [7, 9])


class FitTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.told = io.StringIO()
        with redirect_stdout(cls.told):
            cls.example = runpy.run_path(str(ROOT / "apps/python/examples/pvlib_drop_in.py"))

    def test_the_published_case_comes_back(self):
        found, rmse = self.example["answers"]["lyrefit", "exact curves"]
        for key, value in {**self.example["TRUTH"], "EgRef": 1.121}.items():
            self.assertAlmostEqual(found[key] / value, 1, delta=1e-8, msg=key)
        self.assertLess(rmse, 1e-9)
        noisy, rmse = self.example["answers"]["lyrefit", "with noise of 0.5 mA"]
        self.assertLess(rmse, np.std(self.example["noise"]))
        self.assertAlmostEqual(noisy["EgRef"], 1.121, delta=1e-3)

    def test_keys_and_shapes(self):
        found, _ = self.example["answers"]["lyrefit", "exact curves"]
        self.assertEqual(set(found), {"dEgdT", "I_L_ref", "I_o_ref", "EgRef", "R_sh_ref", "R_s", "iph", "io",
                                      "rsh", "rs", "u", "a_ref", "cells_in_series"})
        iph, io_, rs, rsh, _ = self.example["devices"]
        for key, expected in (("iph", iph), ("io", io_), ("rs", rs), ("rsh", rsh)):
            np.testing.assert_allclose(found[key], expected, rtol=1e-8)
        self.assertEqual((found["u"].dtype, found["u"].sum()), (bool, 28))

    def test_another_reference_says_the_same_of_the_curves(self):
        curves = self.example["curves"]
        here, _ = self.example["answers"]["lyrefit", "exact curves"]
        specs = {**self.example["SPECS"], "alpha_sc": 0.8 * self.example["SPECS"]["alpha_sc"]}  # at E0
        there = drop_in.fit_desoto_sandia({**curves, "i_sc": pd.Series(curves["i_sc"])}, specs,
                                          const={"E0": 800.0, "T0": 40.0, "k": 1.38066e-23, "q": 1.60218e-19})
        np.testing.assert_allclose(there["iph"], here["iph"], rtol=1e-8)
        self.assertIsInstance(there["u"], pd.Series)
        # At 800 W/m2 and 40 C the parameters are those of the device there.
        expected = self.example["desoto"](np.array([800.0]), np.array([40.0]), **self.example["TRUTH"])
        found = (there["I_L_ref"], there["I_o_ref"], there["R_s"], there["R_sh_ref"], there["a_ref"])
        np.testing.assert_allclose(np.ravel(found), np.ravel(expected), rtol=1e-5)

    def test_one_curve(self):
        curves = self.example["curves"]
        found = drop_in.fit_sandia_simple(curves["v"][6], curves["i"][6])
        expected = [row[6] for row in self.example["devices"]]
        np.testing.assert_allclose(found, expected, rtol=1e-6)

    def test_bad_input_is_told(self):
        curves = {**self.example["curves"], "ee": np.full(28, np.nan)}
        with self.assertRaises(ValueError):
            drop_in.fit_desoto_sandia(curves, self.example["SPECS"])


class PvlibTest(unittest.TestCase):
    """Where pvlib is at hand, it is asked itself."""

    def setUp(self):
        try:
            from pvlib import pvsystem
        except ImportError:
            self.skipTest("pvlib is not installed")
        self.pvlib = pvsystem

    def test_same_points(self):
        random = np.random.default_rng(3)
        # Modules: of small cells with a large Rs pvlib's Newton flies off.
        devices = [random.uniform(0.1, 12, 200), 10 ** random.uniform(-12, -7, 200),
                   random.uniform(0, 0.5, 200), random.uniform(50, 2000, 200), random.uniform(0.8, 3, 200)]
        ours = drop_in.singlediode(*devices)
        theirs = self.pvlib.singlediode(*devices, method="newton")
        self.assertEqual(list(theirs.columns), list(ours.columns))
        np.testing.assert_allclose(ours, theirs, rtol=1e-9)
        self.assertEqual(list(self.pvlib.singlediode(*DEVICE)), list(drop_in.singlediode(*DEVICE)))

    def test_same_keys_of_the_fit(self):
        try:
            import statsmodels.api  # noqa: F401
        except ImportError:
            self.skipTest("statsmodels, which pvlib's fit needs, is not installed")
        from pvlib.ivtools import sdm

        ours, ours_rmse = FitTest.example["answers"]["lyrefit", "exact curves"]
        theirs, theirs_rmse = FitTest.example["answers"]["pvlib", "exact curves"]
        self.assertEqual(set(theirs), set(ours))
        self.assertLess(ours_rmse, theirs_rmse)
        self.assertIs(FitTest.example["functions"]["pvlib"], sdm.fit_desoto_sandia)


if __name__ == "__main__":
    unittest.main()
