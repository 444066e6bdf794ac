"""A long fit hears Ctrl-C within a second, tells its progress and lets other threads run."""

import os
import signal
import threading
import time
import unittest

import lyrefit
from helpers import DATA

CELL = lyrefit.read_curve(DATA / "rtc_france")
# Minutes of searching, if nobody stopped it.
LONG = dict(algorithm="de", population=2000, iterations=1000000, threads=2)


class Work(unittest.TestCase):
    def interrupted_after(self, call):
        """Seconds from the signal, sent half a second after the beginning, to the exception."""
        sent = []

        def send():
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        timer = threading.Timer(0.5, send)
        timer.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                call()
            return time.monotonic() - sent[0]
        finally:
            timer.join()

    def test_interrupt(self):
        for call in (
            lambda: lyrefit.fit(CELL, **LONG),
            lambda: lyrefit.fit(CELL, model="td", with_="nonohmic_shunt", **LONG),
            lambda: lyrefit.fit_many([CELL] * 4, **LONG),
            lambda: lyrefit.fit(CELL, **dict(LONG, threads=1)),
        ):
            self.assertLess(self.interrupted_after(call), 1)
            self.assertTrue(lyrefit.fit(CELL).usable)  # all goes on as before

    def test_an_exception_of_the_handler(self):
        def handler(*_):
            raise TimeoutError("too long")

        before = signal.signal(signal.SIGALRM, handler)
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        try:
            with self.assertRaisesRegex(TimeoutError, "too long"):
                lyrefit.fit(CELL, **LONG)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
            signal.signal(signal.SIGALRM, before)

    def test_other_threads_run(self):
        ticks = []
        over = threading.Event()

        def tick():
            while not over.wait(0.01):
                ticks.append(time.monotonic())

        ticker = threading.Thread(target=tick)
        ticker.start()
        lyrefit.fit(CELL, time_limit=0.5, **LONG)
        over.set()
        ticker.join()
        self.assertGreater(len(ticks), 20)
        self.assertLess(max(b - a for a, b in zip(ticks, ticks[1:])), 0.25)

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
        result = lyrefit.fit(CELL, time_limit=0.4, progress=heard.append, **options)
        self.assertFalse(result["interrupted"])
        self.assertGreaterEqual(len(heard), 3)
        self.assertLessEqual(len(heard), 20)
        self.assertIsInstance(heard[0], lyrefit.Progress)
        self.assertEqual(heard[0].stage, "search")
        self.assertEqual(heard[0].iterations, LONG["iterations"])
        self.assertGreater(heard[1].evaluations, heard[0].evaluations)
        self.assertGreaterEqual(heard[0].best, heard[1].best)

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
