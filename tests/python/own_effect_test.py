"""Effects of one's own as functions of Python."""

import unittest

import numpy as np

import lyrefit
from helpers import DATA, without_clocks

CELL = DATA / "rtc_france"
PROBES = [(0.02, 1.5), (0.02, 2), (0.02, 3), (0.02, 4.5)]


def shunt(voltage, k, m, *, reach):
    size = np.abs(voltage) / reach + 1e-9
    return np.where(voltage < 0, 1, -1) * k * np.exp(m * np.log(size))


def shunt_derivatives(voltage, k, m, *, reach):
    size = np.abs(voltage) / reach + 1e-9
    power = np.exp(m * np.log(size))
    sign = np.where(voltage < 0, 1, -1)
    return {"voltage": -k * m * power / size / reach, "k": sign * power, "m": sign * k * power * np.log(size)}


def own_shunt(**more):
    """The non-ohmic shunt of the catalogue, once more."""
    return lyrefit.Effect("own_shunt", {"k": {"bounds": (0, 3), "current_power": 1}, "m": {"bounds": (1.3, 5), "start": 2}},
                          junction=shunt, probes=PROBES, **more)


def contact(current, r, *, photocurrent):
    return r * current * np.abs(current) + 0 * photocurrent


class OwnEffect(unittest.TestCase):
    def check_same(self, expected, found, tolerance):
        self.assertEqual(len(expected.parameters), len(found.parameters))
        self.assertAlmostEqual(found["rmse"]["refined"]["solved_current_A"] /
                               expected["rmse"]["refined"]["solved_current_A"], 1, delta=1e-9)
        for name in ("photocurrent", "saturation_current", "n", "resistance_series"):
            self.assertAlmostEqual(found.parameters[name] / expected.parameters[name], 1, delta=tolerance)

    def test_repeats_one_of_the_catalogue(self):
        expected = lyrefit.fit(CELL, with_="nonohmic_shunt")
        m = expected.parameters["nonohmic_shunt_shunt_exponent"]
        tolerance = 1e-7  # an optimum is flat: where it lies is known to some square roots of a rounding
        for effect in (own_shunt(junction_derivatives=shunt_derivatives), own_shunt()):
            found = lyrefit.fit(CELL, with_=effect)
            self.check_same(expected, found, tolerance)
            self.assertAlmostEqual(found.parameters["own_shunt_m"] / m, 1, delta=tolerance)
            reach = lyrefit.read_curve(CELL).voltage.max()
            self.assertAlmostEqual(found.parameters["own_shunt_k"] * reach**-m /
                                   expected.parameters["nonohmic_shunt_shunt_strength"], 1, delta=10 * tolerance)

    def test_same_digits_again(self):
        effect = own_shunt()
        self.assertEqual(without_clocks(lyrefit.fit(CELL, with_=effect).json),
                         without_clocks(lyrefit.fit(CELL, with_=[effect], threads=3).json))

    def test_series_and_simulation(self):
        """What is simulated with it is what was put in; a fit finds it."""
        device = {"Iph": 0.76, "Is1": 3e-7, "n1": 1.48, "Rs": 0.03, "Rsh": 55.0}
        effect = lyrefit.Effect("contact", {"r": (0, 0.2)}, series=contact)
        plain = lyrefit.simulate(device, temperature_C=33)
        bent = {"voltage": plain.voltage, "temperature_C": 33, "with_": (effect, {"r": 0.05})}
        curve = lyrefit.simulate(device, **bent)
        same = lyrefit.simulate(device, voltage=plain.voltage, temperature_C=33, with_={effect: {"r": 0}})
        np.testing.assert_allclose(same.current, plain.current, rtol=0, atol=1e-12)
        self.assertGreater(np.max(plain.current - curve.current), 0.01)
        found = lyrefit.fit(lyrefit.simulate(device, noise_A=1e-4, seed=1, **bent), with_=effect)
        r = found["parameters"]["contact.r"]
        self.assertAlmostEqual(r["refined"], 0.05, delta=3 * r["standard_error"])
        self.assertLess(found["rmse"]["refined"]["solved_current_A"], 1.1e-4)

    def test_is_diagnosed(self):
        device = {"Iph": 8.2, "Is1": 2e-9, "n1": 1.15, "Rs": 0.25, "Rsh": 300.0}
        curve = lyrefit.simulate(device, voltage=np.linspace(-10, 37, 70), cells_in_series=60, noise_A=1e-3, seed=2,
                                 with_="nonohmic_shunt:k=0.8,m=3")
        options = {"held_out": False, "noise": "white", "floor_current": 0, "floor_power": 0}
        expected = lyrefit.diagnose(curve, effects=["nonohmic_shunt", "second_diode"], **options)
        found = lyrefit.diagnose(curve, effects=[own_shunt(), "second_diode"], **options)
        self.assertEqual(expected.causes, ["nonohmic_shunt"])
        self.assertEqual(found.causes, ["own_shunt"])
        self.assertAlmostEqual(found["gain"]["rmse_after_A"] / expected["gain"]["rmse_after_A"], 1, delta=1e-9)
        self.assertIn("own_shunt", list(found.frame()["effect"]))

    def test_exceptions_come_out(self):
        def broken(voltage, k):
            raise ZeroDivisionError("mine")

        def short(voltage, k):
            return voltage[:-1]

        effect = lyrefit.Effect("broken", {"k": (0, 1)}, junction=broken)
        for _ in range(2):  # and leave nothing behind
            with self.assertRaisesRegex(ZeroDivisionError, "mine"):
                lyrefit.fit(CELL, with_=effect)
        with self.assertRaisesRegex(ZeroDivisionError, "mine"):
            lyrefit.simulate({"Iph": 0.76, "Is1": 3e-7, "n1": 1.48, "Rs": 0.03, "Rsh": 55.0}, with_=(effect, {"k": 0.1}))
        with self.assertRaisesRegex(lyrefit.Error, "Effect 'short': junction: expected .* numbers"):
            lyrefit.fit(CELL, with_=lyrefit.Effect("short", {"k": (0, 1)}, junction=short))

    def test_what_cannot_be_called_is_refused(self):
        for parameters, functions, sentence in (
            ({"k": (0, 1)}, {}, "needs a junction or a series function"),
            ({"k": (0, 1)}, {"junction": lambda v: v}, "takes 1 arguments, expected 2"),
            ({"k": (0, 1)}, {"junction": lambda v, k, *, light: v}, "takes 'light' by keyword"),
            ({"k": (1, 0)}, {"junction": lambda v, k: v}, "expected finite bounds"),
            ({}, {"junction": lambda v: v}, "expected parameters as"),
        ):
            with self.assertRaisesRegex(lyrefit.Error, sentence):
                lyrefit.Effect("outlier", parameters, **functions)
        with self.assertRaisesRegex(TypeError, "junktion"):
            lyrefit.Effect("outlier", {"k": (0, 1)}, junktion=shunt)


if __name__ == "__main__":
    unittest.main()
