"""The searches that stand beside the library's own in comparisons."""

import unittest

import numpy as np

import lyrefit
from helpers import DATA
from lyrefit import searches

ALL = [getattr(searches, name) for name in searches.__all__]
LOWER, UPPER = np.array([-1.0, 10.0, 0.0]), np.array([1.0, 30.0, 1e-6])
LEAST = np.array([0.3, 12.0, 7e-7])


def options(seed=0, run=0, population=20, iterations=200):
    start = LOWER + np.random.default_rng([seed, run, 1]).random((population, len(LOWER))) * (UPPER - LOWER)
    return {"seed": seed, "run": run, "population": population, "iterations": iterations, "start": start}


class Bowl:
    """The distance from LEAST in the unit box, with the points it was asked for."""

    def __init__(self):
        self.points = []

    def __call__(self, points):
        self.points += list(np.atleast_2d(points))
        distance = np.sqrt(np.mean(((points - LEAST) / (UPPER - LOWER)) ** 2, axis=-1))
        return float(distance) if np.ndim(points) == 1 else distance


class Searches(unittest.TestCase):
    def test_all_stay_in_the_box_within_the_budget_and_return_their_best(self):
        for search in ALL:
            with self.subTest(search.__name__):
                bowl = Bowl()
                found = search(bowl, LOWER, UPPER, options())
                asked = np.array(bowl.points)
                self.assertEqual(len(asked), 20 * 201)
                self.assertTrue((asked >= LOWER).all() and (asked <= UPPER * (1 + 1e-15)).all())
                self.assertEqual(Bowl()(found), Bowl()(asked).min())
                self.assertLess(Bowl()(found), 0.02)

    def test_seed_and_run_decide(self):
        for search in ALL:
            with self.subTest(search.__name__):
                first, again, run, seed = (search(Bowl(), LOWER, UPPER, options(*numbers, iterations=20))
                                           for numbers in ((3, 1), (3, 1), (3, 2), (4, 1)))
                np.testing.assert_array_equal(first, again)
                self.assertTrue((first != run).any() and (first != seed).any())

    def test_covariance_adaptation_reaches_the_proved_optimum(self):
        result = lyrefit.compare(DATA / "rtc_france", models="sd", runs=5, population=20, iterations=1000, polish=False,
                                 algorithms=[searches.cma_es])
        self.assertTrue(result["problems"][0]["reference"]["certified"])
        self.assertLess(abs(result.frame().median_searched_A[0] / result.frame().reference_A[0] - 1), 1e-9)


if __name__ == "__main__":
    unittest.main()
