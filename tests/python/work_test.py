"""A long fit hears Ctrl-C, tells its progress and lets other threads run."""

import os
import signal
import threading
import unittest

import lyrefit
from helpers import DATA

CELL = lyrefit.read_curve(DATA / "rtc_france")
# Hours of searching, if nobody stopped it.
LONG = dict(algorithm="de", population=2000, iterations=10000000, threads=2)


class Work(unittest.TestCase):
    def signalled(self, number, call):
        """What `call(progress=...)` does when the signal comes as soon as it has told a first progress."""
        begun = threading.Event()

        def send():
            begun.wait()
            os.kill(os.getpid(), number)

        sender = threading.Thread(target=send)
        sender.start()
        try:
            return call(progress=lambda progress: begun.set())
        finally:
            begun.set()
            sender.join()

    def test_interrupt(self):
        for call in (
            lambda **more: lyrefit.fit(CELL, **LONG, **more),
            lambda **more: lyrefit.fit(CELL, model="td", with_="nonohmic_shunt", **LONG, **more),
            lambda **more: lyrefit.fit_many([CELL] * 4, **LONG, **more),
            lambda **more: lyrefit.fit(CELL, **dict(LONG, threads=1), **more),
        ):
            with self.assertRaises(KeyboardInterrupt):
                self.signalled(signal.SIGINT, call)
            self.assertTrue(lyrefit.fit(CELL).usable)  # all goes on as before

    def test_an_exception_of_the_handler(self):
        def handler(*_):
            raise TimeoutError("too long")

        before = signal.signal(signal.SIGALRM, handler)
        try:
            with self.assertRaisesRegex(TimeoutError, "too long"):
                self.signalled(signal.SIGALRM, lambda **more: lyrefit.fit(CELL, **LONG, **more))
        finally:
            signal.signal(signal.SIGALRM, before)

    def test_other_threads_run(self):
        """The fit ends when another thread has counted on beside it."""
        ticks = []
        over = threading.Event()

        def tick():
            while not over.wait(0.001):
                ticks.append(0)

        ticker = threading.Thread(target=tick)
        ticker.start()
        try:
            result = lyrefit.fit(CELL, progress=lambda progress: len(ticks) < 20, **LONG)
        finally:
            over.set()
            ticker.join()
        self.assertTrue(result["interrupted"])
        self.assertGreaterEqual(len(ticks), 20)

    def test_from_other_threads(self):
        """Several at once, each with its own answer."""
        found = {}

        def fit(seed):
            found[seed] = lyrefit.fit(CELL, seed=seed, polish=False).parameters

        threads = [threading.Thread(target=fit, args=(seed,)) for seed in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for seed in range(4):
            self.assertEqual(found[seed], lyrefit.fit(CELL, seed=seed, polish=False).parameters)

    def test_progress(self):
        for threads in (1, 2):
            with self.subTest(threads=threads):
                self.hear(dict(LONG, threads=threads))

    def hear(self, options):
        heard = []

        def hear(progress):
            heard.append(progress)
            return len(heard) < 3

        self.assertTrue(lyrefit.fit(CELL, progress=hear, **options)["interrupted"])
        self.assertEqual(len(heard), 3)
        self.assertIsInstance(heard[0], lyrefit.Progress)
        self.assertEqual(heard[0].stage, "search")
        self.assertEqual(heard[0].iterations, LONG["iterations"])
        self.assertGreater(heard[1].evaluations, heard[0].evaluations)
        self.assertGreaterEqual(heard[0].best, heard[1].best)

    def test_a_time_limit_is_no_interrupt(self):
        self.assertFalse(lyrefit.fit(CELL, time_limit=0.01, **LONG)["interrupted"])

    def test_progress_that_ends_it(self):
        result = lyrefit.fit(CELL, progress=lambda progress: False, **LONG)
        self.assertTrue(result["interrupted"])
        self.assertIn("photocurrent", result.parameters)

        def broken(progress):
            raise LookupError("mine")

        with self.assertRaisesRegex(LookupError, "mine"):
            lyrefit.fit(CELL, progress=broken, **LONG)
        with self.assertRaises(TypeError):
            lyrefit.fit(CELL, progress=3, **LONG)

    def test_progress_of_many(self):
        heard = []
        lyrefit.fit_many([CELL] * 5, progress=heard.append)
        self.assertEqual((heard[-1].iteration, heard[-1].iterations), (5, 5))


if __name__ == "__main__":
    unittest.main()
