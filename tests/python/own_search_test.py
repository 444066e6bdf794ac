"""What compare() tells a search of one's own, and what it says of what such a search returns."""

import functools
import json
import math
import os
import pathlib
import subprocess
import tempfile
import time
import unittest

import numpy as np

import lyrefit
from helpers import DATA, without_clocks
from lyrefit import searches

CELL = DATA / "rtc_france"
SMALL = dict(models="sd", runs=3, population=10, iterations=10, polish=False)


def best_of(objective, points):
    return points[np.argmin(objective(points))]


class Pictures(unittest.TestCase):
    def test_the_convergence_of_ones_own_search_is_drawn(self):
        def mine(objective, lower, upper, options):
            return best_of(objective, options["start"])

        result = lyrefit.compare(CELL, algorithms=[mine, "mlo"], **SMALL)
        with tempfile.TemporaryDirectory() as folder:
            svg, pdf = pathlib.Path(folder) / "c.svg", pathlib.Path(folder) / "c.pdf"
            result.save_plot(svg, kind="convergence")
            text = svg.read_text(encoding="utf-8")
            for words in ("mine", "mlo", "Evaluations"):
                self.assertIn(words, text)
            result.save_plot(pdf, kind="convergence")
            self.assertEqual(pdf.read_bytes()[:5], b"%PDF-")
            with self.assertRaisesRegex(lyrefit.Error, "expected 'plot' or 'convergence', found 'boxes'"):
                result.save_plot(svg, kind="boxes")
            with self.assertRaisesRegex(lyrefit.Error, "only a result of compare"):
                lyrefit.fit(CELL).save_plot(svg, kind="convergence")


class Peers(unittest.TestCase):
    def test_pagmo_is_there_or_the_way_around_it_is_said(self):
        try:
            result = lyrefit.compare(CELL, algorithms=["pagmo:cmaes", "mlo"], **SMALL)
        except lyrefit.Error as error:
            self.assertRegex(str(error), "wheels and packages leave out.*lyrefit.searches.cma_es")
            return
        command = [os.environ["LYREFIT_COMMAND"], "compare", CELL, "--algorithms", "pagmo:cmaes,mlo", "--models", "sd", "--runs", "3",
                   "--population", "10", "--iterations", "10", "--no-polish", "--json", "-"]
        said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        self.assertEqual(without_clocks(result.json), without_clocks(said))
        with self.assertRaisesRegex(lyrefit.Error, "pagmo:nobody: expected one of de, sade"):
            lyrefit.compare(CELL, algorithms="pagmo:nobody", **SMALL)


class Told(unittest.TestCase):
    def options_of(self, curve=CELL, **keywords):
        seen = []

        def look(objective, lower, upper, options):
            seen.append((lower, upper, options, objective(options["start"])))
            return options["start"][0]

        lyrefit.compare(curve, algorithms=["mlo", look], **SMALL | keywords)
        return seen

    def test_coordinates(self):
        """A coordinate is the value of its parameter, or its logarithm above the lower end."""
        lower, upper, options, _ = self.options_of()[0]
        parameters = options["parameters"]
        self.assertEqual([p["name"] for p in parameters],
                         ["photocurrent", "saturation_current", "n", "resistance_series", "resistance_shunt"])
        self.assertEqual([p["scale"] for p in parameters], ["linear", "log", "linear", "linear", "log"])
        self.assertEqual([p["unit"] for p in parameters], ["A", "A", "", "ohm", "ohm"])
        for k, p in enumerate(parameters):
            ends = [p["lower"] * math.exp(x) if p["scale"] == "log" else x for x in (lower[k], upper[k])]
            np.testing.assert_allclose(ends, [p["lower"], p["upper"]], rtol=1e-12)
        published = self.options_of(bounds="literature")[0]
        self.assertEqual({p["scale"] for p in published[2]["parameters"]}, {"linear"})
        self.assertEqual([p["upper"] for p in published[2]["parameters"]], list(published[1]))

    def test_the_known_optimum_at_its_coordinates(self):
        values = dict(photocurrent=0.7607755, saturation_current=3.2302e-7, n=1.481184, resistance_series=0.0363771,
                      resistance_shunt=53.7185)
        found = []

        def known(objective, lower, upper, options):
            at = [math.log(values[p["name"]] / p["lower"]) if p["scale"] == "log" else values[p["name"]]
                  for p in options["parameters"]]
            found.append(objective(at))
            return at

        for bounds in ("physical", "literature"):
            lyrefit.compare(CELL, algorithms=known, bounds=bounds, **SMALL)
        self.assertEqual(len(found), 6)
        self.assertLess(max(found) / 9.8602e-4 - 1, 1e-4)

    def test_the_effects_of_a_model(self):
        sides = self.options_of(DATA / "diagnosis" / "shaded_module.csv", with_="shading")[0][2]["parameters"]
        self.assertTrue(any(p["name"].startswith("shading.") for p in sides), sides)

    def test_the_points_that_the_library_starts_from(self):
        seen = self.options_of()
        result = lyrefit.compare(CELL, algorithms="mlo,de,random", **SMALL)
        for run, (lower, upper, options, values) in enumerate(seen):
            self.assertEqual(options["start"].shape, (10, 5))
            self.assertTrue(((options["start"] >= lower) & (options["start"] <= upper)).all())
            for algorithm in result["problems"][0]["algorithms"]:
                trace = lyrefit.compare(CELL, algorithms=algorithm["name"], **SMALL | dict(runs=run + 1))
                runs = trace["problems"][0]["algorithms"][0]["runs"]
                self.assertLessEqual(runs[run]["searched_A"], values.min())
        first = lyrefit.compare(CELL, algorithms=["random", *(getattr(searches, name) for name in searches.__all__)],
                                **SMALL | dict(runs=1, max_evaluations=10, population=10))
        self.assertEqual(len({a["runs"][0]["searched_A"] for a in first["problems"][0]["algorithms"]}), 1)
        self.assertIn("which others may take", " ".join(str(first).split()))

    def test_nan_is_infinity(self):
        def nan(objective, lower, upper, options):
            self.assertEqual(objective(np.full(len(lower), np.nan)), math.inf)
            return lower

        lyrefit.compare(CELL, algorithms=nan, **SMALL)


class Budget(unittest.TestCase):
    def test_a_search_ends_at_its_budget(self):
        """More evaluations raise StopIteration in it; its best point so far is its answer."""
        raised = []

        def endless(objective, lower, upper, options):
            random = np.random.default_rng(options["run"])
            try:
                while True:
                    objective(lower + random.random(len(lower)) * (upper - lower))
            except StopIteration as stop:
                raised.append(str(stop))
                raise

        for limits, evaluations in (({}, 110), ({"max_evaluations": 30}, 30)):
            result = lyrefit.compare(CELL, algorithms=[endless], **SMALL | limits)
            runs = result["problems"][0]["algorithms"][0]["runs"]
            self.assertEqual({run["evaluations"] for run in runs}, {evaluations})
            self.assertEqual(result["warnings"], [])
            draws = np.random.default_rng(0).random((evaluations, 5))

            def same(objective, lower, upper, options, draws=draws):
                return best_of(objective, lower + draws * (upper - lower))

            again = lyrefit.compare(CELL, algorithms=[same], **SMALL | limits | dict(runs=1))
            self.assertEqual(runs[0]["searched_A"], again["problems"][0]["algorithms"][0]["runs"][0]["searched_A"])
        self.assertEqual(set(raised), {"the budget of evaluations is spent"})

    def test_a_fit_has_no_budget(self):
        def long(objective, lower, upper, options):
            return best_of(objective, np.linspace(lower, upper, 1000))

        self.assertEqual(lyrefit.fit(CELL, searcher=long)["search"]["evaluations"], 1000)

    def test_the_time_is_that_of_the_call(self):
        def slow(objective, lower, upper, options):
            time.sleep(0.05)
            return best_of(objective, options["start"])

        table = lyrefit.compare(CELL, algorithms=[slow, "mlo"], **SMALL).frame().set_index("algorithm")
        self.assertGreaterEqual(table.search_seconds["slow"], 0.05)
        self.assertGreaterEqual(lyrefit.fit(CELL, searcher=slow)["search"]["seconds"], 0.05)
        for figure in ("min", "mean", "median", "max", "std"):
            self.assertIn(f"{figure}_searched_A", table.columns)


class Refused(unittest.TestCase):
    def test_what_is_no_point(self):
        box = np.ones(5)
        for wrong in ("hello", None, (box, 0.1), [box, [1.0, 2.0]], object(), {}, box[:4], np.ones((2, 2, 5))):
            for call in (functools.partial(lyrefit.compare, CELL, algorithms=lambda *_, w=wrong: w, **SMALL),
                         functools.partial(lyrefit.fit, CELL, searcher=lambda *_, w=wrong: w)):
                with self.assertRaisesRegex(lyrefit.Error, r"a search has to return its best point, shape \(5,\)"):
                    call()
        for wrong in ("hello", [[1], [1, 2]]):
            with self.assertRaisesRegex(lyrefit.Error, "the objective takes an array of numbers, found (str|list)"):
                lyrefit.compare(CELL, algorithms=lambda objective, *_, w=wrong: objective(w), **SMALL)
        with self.assertRaisesRegex(lyrefit.Error, "expected a function search.*found int"):
            lyrefit.compare(CELL, algorithms={"mine": 3}, **SMALL)

    def test_an_exception_says_where(self):
        def fails(objective, lower, upper, options):
            return lower if options["run"] < 2 else lower / {}

        with self.assertRaises(TypeError) as raised:
            lyrefit.compare(CELL, algorithms=["mlo", fails], seed=7, **SMALL)
        notes = getattr(raised.exception, "__notes__", None)
        self.assertIn(notes, (None, ["raised by the search 'fails' in run 2 of seed 7"]))


class Named(unittest.TestCase):
    def test_objects_and_names(self):
        class Corner:
            def __call__(self, objective, lower, upper, options):
                return lower

        result = lyrefit.compare(CELL, algorithms=[Corner(), {"theirs": "de", "mine": Corner()}], **SMALL)
        self.assertEqual([a["name"] for a in result["problems"][0]["algorithms"]], ["Corner", "theirs", "mine"])
        plain = lyrefit.compare(CELL, algorithms="de", **SMALL)
        theirs, same = (json.loads(without_clocks(text))["problems"][0]["algorithms"][k]["runs"]
                        for text, k in ((result.json, 1), (plain.json, 0)))
        self.assertEqual(theirs, same)


class Resumed(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.journal = pathlib.Path(folder.name) / "journal"

    def compared(self, search, **keywords):
        return lyrefit.compare(CELL, algorithms={"mine": search}, resume=self.journal, **SMALL | keywords)

    def test_a_journal_is_of_one_version_of_a_search(self):
        def corner(objective, lower, upper, options):
            return lower

        def other(objective, lower, upper, options):
            return upper

        def of(step):
            def held(objective, lower, upper, options):
                return lower + step * (upper - lower)
            return held

        first = self.compared(corner)
        more = self.compared(corner, runs=5)
        self.assertEqual(first["problems"][0]["algorithms"][0]["runs"][0]["searched_A"],
                         more["problems"][0]["algorithms"][0]["runs"][0]["searched_A"])
        with self.assertRaisesRegex(lyrefit.Error, "a search of its own"):
            self.compared(other)
        self.journal = self.journal.with_name("second")
        self.compared(of(0.5))
        self.compared(of(0.5))
        with self.assertRaisesRegex(lyrefit.Error, "a search of its own"):
            self.compared(of(0.25))

    def test_what_has_no_source_is_refused(self):
        with self.assertRaisesRegex(lyrefit.Error, "resume: the search 'mine' is no function with a source"):
            self.compared(functools.partial(searches.grey_wolf))
        self.assertFalse(self.journal.exists())


if __name__ == "__main__":
    unittest.main()
