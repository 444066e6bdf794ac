"""What is taken for a curve, and what is said of what cannot be."""

import pathlib
import unittest
import warnings

import numpy as np
import pandas as pd

import lyrefit
from helpers import DATA, command
from lyrefit import _lyrefit

CELL = lyrefit.read_curve(DATA / "rtc_france")
V, I = np.array(CELL.voltage), np.array(CELL.current)
QUICK = dict(temperature_C=33, cells_in_series=1, irradiance_Wm2=1000, intervals="none", find_errors=False)


class Taken(unittest.TestCase):
    def setUp(self):
        self.expected = lyrefit.fit(V, I, **QUICK).parameters

    def same(self, *curve):
        self.assertEqual(self.expected, lyrefit.fit(*curve, **QUICK).parameters)

    def test_a_column_beside_is_as_long_as_the_readings(self):
        count = len(CELL)
        table = {"curve": np.repeat(["a", "b"], count), "v": np.tile(CELL.voltage, 2), "i": np.tile(CELL.current, 2),
                 "irradiance": np.full(count, 900.0)}
        with self.assertRaisesRegex(lyrefit.Error, f"expected {2 * count} values of irradiance, found {count}"):
            lyrefit.fit_family(table, cells_in_series=1)

    def test_kinds(self):
        wide = np.zeros((len(V), 4))
        wide[:, 1], wide[:, 3] = V, I
        frozen = V.copy()
        frozen.setflags(write=False)
        self.same(list(V), tuple(I))
        self.same(wide[:, 1], wide[:, 3])  # not contiguous
        self.same(V[::-1][::-1], I)
        self.same(frozen, I)
        self.same(pd.Series(V, index=range(5, 5 + len(V))), pd.Series(I))
        self.same({"v": V, "i": I, "v_oc": 0.57})
        self.same({"Voltage": V, "Current": I})
        self.same(pd.DataFrame({"V": V, "I": I}))
        self.same((V, I))
        self.same(np.array([V, I]))
        self.same(np.column_stack([V, I]))
        self.same(V.astype(object), I)
        self.same(V.astype(">f8"), I)
        self.same(CELL)
        self.same(str(DATA / "rtc_france" / "curve.csv"))
        self.same(CELL.csv)  # the text of a table

    def test_load_sign(self):
        """As from a file: turned, and said."""
        curve = lyrefit.Curve(V, -I)
        self.assertEqual(list(curve.current), list(I))
        self.assertIn("sign", " ".join(curve.assumptions))

    def test_conditions_beside(self):
        """Columns, or a number in the place of one; a keyword goes before them."""
        rows = {"v": V, "i": I, "irradiance": np.linspace(890, 910, len(V)), "Temperature_C": 41}
        curve = lyrefit.Curve(pd.DataFrame(rows))
        self.assertAlmostEqual(curve.irradiance_Wm2, 900)
        self.assertAlmostEqual(curve.temperature_C, 41)
        self.assertEqual(list(curve.temperature), [41] * len(V))
        self.assertAlmostEqual(lyrefit.Curve(rows, temperature_C=33).temperature_C, 33)

    def test_masked(self):
        masked = np.ma.array(V, mask=np.arange(len(V)) == 2)
        with self.assertRaisesRegex(lyrefit.Error, "voltage at point 3, found nan"):
            lyrefit.fit(masked, I)
        self.assertEqual(list(lyrefit.Curve(masked, I, skip_missing=True).voltage), list(np.delete(V, 2)))

    def test_the_curve_of_a_fit(self):
        fit = lyrefit.fit(CELL, **QUICK)
        self.same(fit)
        self.assertEqual(lyrefit.certify(fit)["floor"], lyrefit.certify(CELL)["floor"])

    def test_float32_and_whole_numbers(self):
        single = lyrefit.fit(V.astype(np.float32), I.astype(np.float32), **QUICK)
        self.assertAlmostEqual(single.parameters["n"], self.expected["n"], places=3)
        whole = lyrefit.Curve(np.arange(3), np.array([3, 2, 1], dtype=np.int16))
        self.assertEqual(list(whole.voltage), [0.0, 1.0, 2.0])

    def test_columns_beside(self):
        curve = lyrefit.Curve({"v": V, "i": I, "sigma": np.full(len(V), 1e-3), "time": np.arange(len(V))})
        self.assertEqual(curve.sigma[0], 1e-3)
        self.assertEqual(list(curve.time[:2]), [0, 1])
        self.assertEqual(list(curve.frame().columns), ["voltage", "current", "sigma", "time"])

    def test_views(self):
        curve = lyrefit.Curve(V, I)
        voltage = curve.voltage
        self.assertFalse(voltage.flags.writeable)
        self.assertIs(voltage.base, curve)
        del curve
        self.assertEqual(voltage[0], V[0])

    def test_missing_readings(self):
        gaps = V.copy()
        gaps[3] = np.nan
        with self.assertRaisesRegex(lyrefit.Error, "finite voltage.* at point 4, found nan"):
            lyrefit.fit(gaps, I)
        curve = lyrefit.Curve(gaps, I, skip_missing=True)
        self.assertEqual(len(curve), len(V) - 1)
        self.assertIn("1 readings without a voltage or a current were left out", curve.assumptions)

    def test_a_fit_that_is_not_usable_warns(self):
        line = 0.3 * (1 - V / 0.6)
        with self.assertWarnsRegex(UserWarning, "^the fit is not usable: a straight line describes") as caught:
            fit = lyrefit.fit(V, line, **QUICK)
        self.assertEqual(pathlib.Path(caught.filename), pathlib.Path(__file__))
        self.assertFalse(fit.usable)
        self.assertEqual(str(caught.warning), fit["warnings"][0])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(UserWarning):
                lyrefit.fit(V, line, **QUICK)
            self.assertTrue(lyrefit.fit(V, I, **QUICK).usable)


class Doubted(unittest.TestCase):
    def test_every_verb_warns_of_doubtful_readings(self):
        module = lyrefit.Curve(V * 70, I * 10, temperature_C=25, irradiance_Wm2=1000)  # 40 V, cells not stated
        dim = lyrefit.Curve(V * 70, I * 5, temperature_C=25, irradiance_Wm2=500)
        cells = r"^DOUBTFUL: .*\(cells_in_series=\)"
        cases = [
            (cells, lambda: lyrefit.fit(module, intervals="none")),
            (cells, lambda: lyrefit.fit_family([module, dim])),
            (cells, lambda: lyrefit.diagnose(module, held_out=False)),
            (cells, lambda: lyrefit.translate(module)),
            ("^DOUBTFUL: ", lambda: lyrefit.cell(V, I, area_cm2=1.0, cells_in_series=1)),  # 760 mA/cm2
        ]
        for said, call in cases:
            with self.assertWarnsRegex(UserWarning, said):
                call()


class Refused(unittest.TestCase):
    def refuse(self, pattern, call, *arguments, kind=lyrefit.Error, **keywords):
        with self.assertRaisesRegex(kind, pattern):
            call(*arguments, **keywords)

    def test_arrays(self):
        fit = lyrefit.fit
        self.refuse("at least two points, found 0", fit, [], [])
        self.refuse("at least two points, found 1", fit, [0.1], [0.2])
        self.refuse("26 voltages and 25 currents", fit, V, I[:-1])
        self.refuse(r"voltage: expected one dimension, found shape \(2, 13\)", fit, V.reshape(2, 13), I)
        self.refuse("voltage: expected an array of numbers, found list of <U1", fit, ["a", "b"], [1, 2])
        self.refuse("current: expected an array of numbers", fit, V, I.astype(complex))
        self.refuse("current: expected an array of numbers, found list", fit, [1, 2], [[1], [1, 2]])
        self.refuse("expected a column 'voltage' or 'v', found", fit, {"x": V, "i": I})
        self.refuse("expected voltage and current, a Curve, a path", fit, 3)
        self.refuse("column: is about a file; readings are taken in V and A", fit, V, I, column=2)
        self.refuse("finite current", fit, V, np.full(len(V), np.inf))

    def test_keywords(self):
        fit = lyrefit.fit
        self.refuse(r"fit\(\) has no keyword 'poulation'; did you mean 'population'\?", fit, CELL, kind=TypeError,
                    poulation=9)
        self.refuse("population: expected a whole number, found 'many'", fit, CELL, population="many")
        self.refuse("population: expected a whole number, found 9.5", fit, CELL, population=9.5)
        self.refuse("seed: expected a whole number from 0, found -1", fit, CELL, seed=-1)
        self.refuse("polish: expected True or False, found 'no'", fit, CELL, polish="no")
        self.refuse("memory_rate: nan is outside", fit, CELL, memory_rate=float("nan"))
        self.refuse("curve_index: 99999999999 is outside", fit, CELL, curve_index=99999999999)
        self.assertEqual(lyrefit.fit(CELL, seed=2**64 - 1)["search"]["seed"], 2**64 - 1)

    def test_no_numbers_no_values(self):
        fit = lyrefit.fit
        self.refuse("voltage: expected an array of numbers, found ndarray of bool", fit, V > 0.2, I)
        masked = np.ma.array(V, mask=np.arange(len(V)) == 3)
        self.refuse("finite voltage at point 4, found nan or a masked value: .*skip_missing=True", fit, masked, I)
        self.assertEqual(len(fit(masked, I, skip_missing=True, **QUICK).curve), len(V) - 1)

    def test_every_flag_is_named_as_its_keyword(self):
        flags = {"cells_in_series": "cells", "curve_index": "curve", "with_": "with"}
        said = _lyrefit._in_keywords
        kinds = {}
        for keywords in _lyrefit._keywords.values():
            for name, kind, *_ in keywords:
                kinds.setdefault(name, set()).add(kind)
        for name, kind in kinds.items():
            flag = "--" + flags.get(name, name).replace("_", "-")
            sign = "=True" if kind == {"bool"} else "="
            self.assertEqual(said(f"give {flag}, or not"), f"give {name}{sign}, or not")
        self.assertGreaterEqual(set(kinds), {"area_cm2", "as_is", "skip_missing", "voltage_column", "cells_in_series"})
        self.assertEqual(said("a tandem: count them, --cells 2) or"), "a tandem: count them, cells_in_series=2) or")
        self.assertEqual(said("say so with --voltage-unit mV, or V"), "say so with voltage_unit='mV', or V")
        self.assertEqual(said("(--as-is takes the readings)"), "(as_is=True takes the readings)")
        self.assertEqual(said("with --no-polish"), "with polish=False")
        self.assertEqual(said("-- --never-a-flag 2 -- --"), "-- --never-a-flag 2 -- --")

    def test_the_commands_sentences(self):
        """What the command says of a flag, the module says of the keyword."""
        cell = DATA / "rtc_france"
        cases = [
            (["--population", 2], {"population": 2}),
            (["--model", "qd"], {"model": "qd"}),
            (["--objective", "both"], {"objective": "both"}),
            (["--fix", "n2"], {"fix": "n2"}),
            (["--fix", "n7=1"], {"fix": {"n7": 1}}),
            (["--bound", "Rs=2:1"], {"bound": {"Rs": (2, 1)}}),
            (["--bounds", "here"], {"bounds": "here"}),
            (["--cells", 0], {"cells_in_series": 0}),
            (["--temperature-C", 300], {"temperature_C": 300}),
            (["--with", "nothing"], {"with_": "nothing"}),
            (["--column", "2"], {"column": 2}),
        ]
        for flags, keywords in cases:
            said = command("fit", cell, *flags, code=1).removeprefix("lyrefit: ").strip()
            with self.subTest(said), self.assertRaises(lyrefit.Error) as raised:
                lyrefit.fit(cell, **keywords)
            flag, keyword = flags[0], next(iter(keywords))
            said = said.removeprefix("error: ").replace(flag, keyword)
            self.assertEqual(said, str(raised.exception))

    def test_files(self):
        with self.assertRaises(lyrefit.Error) as raised:
            lyrefit.read_curve("V,I\n0,1\n0.1,what\n")
        error = raised.exception
        self.assertEqual((error.file, error.line, error.column), ("text", 3, 5))
        self.assertIsInstance(error, ValueError)
        self.assertEqual(str(error), f"text:3:5: {error.message}")
        self.refuse("^nowhere.csv: ", lyrefit.fit, "nowhere.csv")

    def test_simulate(self):
        self.refuse("Rs|resistance_series", lyrefit.simulate, {"Iph": 1})
        self.refuse("no keyword", lyrefit.simulate, kind=TypeError, photocurent=1)
        self.refuse("voltage: expected at least one", lyrefit.simulate, {"Iph": 1}, [])
        self.refuse("photocurrent: expected a number, found 'x'", lyrefit.simulate, photocurrent="x")


class Many(unittest.TestCase):
    def test_one_bad_curve_loses_nothing(self):
        bad = [(V, I), (V[:1], I[:1]), (V, I * np.nan), (V, 0 * I), "nowhere.csv", None, ([1, 2], ["a", "b"]), (V, I)]
        results = lyrefit.fit_many(bad, **QUICK)
        table = results.frame()
        self.assertEqual(list(table.status), ["fine"] + ["broken"] * 6 + ["fine"])
        self.assertTrue((table.reason[1:7] != "").all())
        self.assertEqual(table.photocurrent[0], table.photocurrent[7])
        self.assertEqual(table.photocurrent[0], lyrefit.fit(V, I, **QUICK).parameters["photocurrent"])
        self.assertTrue(np.isnan(table.photocurrent[3]))
        with self.assertRaisesRegex(lyrefit.Error, "nowhere.csv"):
            results[4]
        self.assertEqual(len(results), 8)
        self.assertEqual(results[-1].parameters, results["0"].parameters)
        for place in (8, -9):
            with self.assertRaises(IndexError):
                results[place]
        with self.assertRaises(KeyError):
            results["9"]

    def test_shapes_of_many(self):
        """Rows, a long frame, a mapping and a list say the same."""
        voltages = np.full((3, len(V) + 2), np.nan)
        currents = voltages.copy()
        for row, factor in enumerate((1, 0.8, 0.6)):
            voltages[row, : len(V)], currents[row, : len(V)] = V, factor * I
        told = dict(QUICK, irradiance_Wm2=[1000, 800, 600])
        table = lyrefit.fit_many(voltages, currents, **told).frame()
        self.assertEqual(list(table.irradiance_Wm2), [1000, 800, 600])
        columns = ["photocurrent", "n", "resistance_shunt", "p_mp", "rmse_solved_current", "nNsVth", "temperature_C"]
        listed = lyrefit.fit_many([(V, f * I) for f in (1, 0.8, 0.6)], **told).frame()
        mapped = lyrefit.fit_many({"a": (V, I), "b": (V, 0.8 * I), "c": (V, 0.6 * I)}, **told)
        common = lyrefit.fit_many(V, currents[:, : len(V)], **told).frame()
        order = np.argsort(np.tile(np.arange(len(V)), 3), kind="stable")  # rows of the curves mixed
        frame = pd.DataFrame({"site": "x", "string": np.repeat([2, 1, 3], len(V)), "v": np.tile(V, 3),
                              "i": np.concatenate([I, 0.8 * I, 0.6 * I]),
                              "irradiance_Wm2": np.repeat([1000, 800, 600], len(V))}).iloc[order]
        quick = {key: value for key, value in QUICK.items() if key != "irradiance_Wm2"}
        grouped = lyrefit.fit_many(frame, group=["site", "string"], **quick).frame()
        self.assertEqual(list(grouped.id), ["x/2", "x/1", "x/3"])
        by_string = lyrefit.fit_many(frame.groupby("string", sort=False), **quick).frame()
        self.assertEqual(list(by_string.id), ["2", "1", "3"])
        self.assertEqual(list(mapped.frame().id), ["a", "b", "c"])
        for other in (listed, mapped.frame(), common, grouped, by_string):
            pd.testing.assert_frame_equal(table[columns], other[columns], check_exact=True)

    def test_a_file_of_many(self):
        table = lyrefit.fit_many(DATA / "plant" / "strings.csv", intervals="none", find_errors=False,
                                 population=4, iterations=1).frame()
        self.assertGreater(len(table), 10)
        self.assertTrue(table.id.is_unique)

    def test_refused(self):
        for pattern, arguments, keywords in [
            ("temperature_C: expected one for each of 2 curves, found 3", [[(V, I)] * 2], {"temperature_C": [1, 2, 3]}),
            (r"shape \(m, n\)", [np.zeros((2, 3)), np.zeros((3, 3))], {}),
            ("group: expected the column", [pd.DataFrame({"v": V, "i": I})], {}),
            ("group: expected the column.*'v', 'i'", [pd.DataFrame({"v": V, "i": I})], {"group": "string"}),
            ("curves: expected a list", [3], {}),
            ("population: 1 is outside", [[(V, I)]], {"population": 1}),
        ]:
            with self.subTest(pattern), self.assertRaisesRegex(lyrefit.Error, pattern):
                lyrefit.fit_many(*arguments, **keywords)
        self.assertEqual(len(lyrefit.fit_many([]).frame()), 0)


if __name__ == "__main__":
    unittest.main()
