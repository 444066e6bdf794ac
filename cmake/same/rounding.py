"""Whether two contents differ by the rounding of numbers alone."""

import csv
import dataclasses
import io
import json
import math
import re

NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
SATURATION = re.compile(r"saturation|\b(Is|Io|I_o|J0)(\d|_|\b)")  # currents of which none is near zero, by what names them
NEAR_ZERO = 1e-3  # in the number's own unit: volts, amperes, ohms, parts of one
DIGITS = 3  # least digits of a printed number whose last one may differ by one


@dataclasses.dataclass
class Rounding:
    """How far two contents differ: numbers that are not equal as texts, the largest relative difference, and how many of them
    differ by more than that, but by one in their last printed digit."""

    numbers: int = 0
    largest: float = 0.0
    last_digits: int = 0

    def add(self, other):
        self.numbers += other.numbers
        self.largest = max(self.largest, other.largest)
        self.last_digits += other.last_digits


class Different(Exception):
    """The contents differ by more than rounding."""


def last_digit(text):
    """One in the last digit of a printed number, or zero if it is an integer or has too few digits."""
    mantissa, _, exponent = text.lower().lstrip("+-").partition("e")
    whole, point, part = mantissa.partition(".")
    if not (point or exponent) or len((whole + part).lstrip("0")) < DIGITS:
        return 0.0
    return 10.0 ** (int(exponent or 0) - len(part))


class _Comparison:
    """Of two contents, within a relative tolerance."""

    def __init__(self, relative):
        self.relative, self.found = relative, Rounding()

    def number(self, old, new, exact, printed):
        """Two numbers as they are written. Integers must be equal. Others agree within the tolerance of the larger one, or of
        NEAR_ZERO if that is larger and they are not `exact` (saturation currents), or, where texts are `printed` with fewer
        digits, by one in the last digit: a rounding may fall to either side of it."""
        if old == new:
            return
        first, second = float(old), float(new)
        self.found.numbers += 1
        if first != second and old.lstrip("+-").isdigit() and new.lstrip("+-").isdigit() or not math.isfinite(first - second):
            raise Different
        size = max(abs(first), abs(second), 0 if exact else NEAR_ZERO)
        if abs(first - second) <= self.relative * size:
            self.found.largest = max(self.found.largest, abs(first - second) / size if size else 0)
        elif printed and abs(first - second) <= 1.001 * min(last_digit(old), last_digit(new)):
            self.found.last_digits += 1
        else:
            raise Different

    def text(self, old, new):
        """Lines of printed words and numbers. All between the numbers must be equal, but for the width of columns."""
        lines = [content.split("\n") for content in (old, new)]
        if len(lines[0]) != len(lines[1]):
            raise Different
        for first, second in zip(*lines):
            if first == second:
                continue
            between = [re.sub(" +", " ", " 0 ".join(NUMBER.split(line))) for line in (first, second)]
            if between[0] != between[1]:
                raise Different
            exact = SATURATION.search(first) is not None
            for one, other in zip(NUMBER.findall(first), NUMBER.findall(second)):
                self.number(one, other, exact, True)

    def document(self, old, new, exact=False):
        """Two values of JSON. Numbers have all their digits."""
        if type(old) is not type(new) or isinstance(old, (dict, list)) and len(old) != len(new):
            raise Different
        if isinstance(old, dict):
            if list(old) != list(new):
                raise Different
            # A record may say in words what its numbers are: {"symbol": "Is1", "refined": 1e-9}.
            said = " ".join(old[key] for key in ("symbol", "name", "parameter") if type(old.get(key)) is str)
            exact = exact or SATURATION.search(said) is not None
            for key in old:
                self.document(old[key], new[key], exact or SATURATION.search(key) is not None)
        elif isinstance(old, list):
            for one, other in zip(old, new):
                self.document(one, other, exact)
        elif isinstance(old, _Written):
            self.number(old, new, exact, False)
        elif isinstance(old, str):
            self.text(old, new)
        elif old is not new:  # true, false, null
            raise Different

    def table(self, old, new):
        """Two CSV tables. Numbers have all their digits."""
        tables = [list(csv.reader(io.StringIO(content))) for content in (old, new)]
        if [len(row) for row in tables[0]] != [len(row) for row in tables[1]]:
            raise Different
        names = tables[0][0] if tables[0] else []
        for one, other in zip(*tables):
            for column, (first, second) in enumerate(zip(one, other)):
                if NUMBER.fullmatch(first) and NUMBER.fullmatch(second):
                    self.number(first, second, column < len(names) and SATURATION.search(names[column]) is not None, False)
                else:
                    self.text(first, second)


class _Written(str):
    """A number of JSON as it is written."""


def rounding(what, old, new, relative):
    """The rounding by which two contents differ, or nothing if they differ otherwise. `what` names them, as in
    `file fit.csv`."""
    comparison = _Comparison(relative)
    try:
        texts = [content.decode("utf-8") for content in (old, new)]
        try:
            documents = [json.loads(text, parse_float=_Written, parse_int=_Written) for text in texts]
        except json.JSONDecodeError:
            documents = []
        if documents or what.endswith(".csv"):
            if NUMBER.split(texts[0]) != NUMBER.split(texts[1]):
                return None
            comparison.document(*documents) if documents else comparison.table(*texts)
        else:
            comparison.text(*texts)
    except (Different, UnicodeDecodeError, csv.Error):
        return None
    return comparison.found
