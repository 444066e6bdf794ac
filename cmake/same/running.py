"""Runs a case with a build of the command, and compares what two builds printed and wrote."""

import base64
import dataclasses
import difflib
import gzip
import os
import re
import shutil
import signal
import subprocess
import threading
import time

from rounding import Rounding, rounding

# What differs from run to run of one build: durations, and nothing else. Both builds run under the same name in a folder
# of the same path, so that no path differs.
MASKS = [
    (rb'seconds": ?[-+.0-9e]+', b'seconds": 0'),  # JSON
    (rb' *\b[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)? +(us|ms|s|min)\b', b" 0 s"),  # texts, and columns of tables
    (rb"\b[0-9]+ a second\b", b"0 a second"),  # of a batch
]


@dataclasses.dataclass
class Outcome:
    """What a case left behind: bytes by what they are, or nothing if the limit ended it."""

    parts: dict | None
    seconds: float


class Runner:
    """Runs cases in a folder, anew for each."""

    _running = set()
    _lock = threading.Lock()

    def __init__(self, folder, links, limit):
        self.folder, self.home = folder / "run", folder / "home"
        self.links, self.limit = links, limit

    @classmethod
    def end_all(cls):
        with cls._lock:
            for process in cls._running:
                os.killpg(process.pid, signal.SIGKILL)

    def _prepare(self, case):
        for folder in (self.folder, self.home):
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
        for name, target in self.links.items():
            (self.folder / name).symlink_to(target)
        for name, text in case.given:
            file = self.folder / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")

    def _step(self, binary, step, limit):
        """The exit code and both outputs of a step; nothing if the limit ended it."""
        environment = {"PATH": os.environ.get("PATH", ""), "HOME": str(self.home), "LC_ALL": "C.UTF-8", "TZ": "UTC"}
        source = self.folder / step.standard_input if step.standard_input else os.devnull
        with open(source, "rb") as standard_input:
            process = subprocess.Popen(["lyrefit", *step.arguments], executable=binary, cwd=self.folder, env=environment,
                                       stdin=standard_input, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                       start_new_session=True)
        with self._lock:
            self._running.add(process)
        try:
            out, error = process.communicate(timeout=limit)
            return process.returncode, out, error
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return None
        finally:
            with self._lock:
                self._running.discard(process)

    def run(self, case, binary):
        self._prepare(case)
        parts = {}
        begin = time.monotonic()
        for number, step in enumerate(case.steps, 1):
            left = self.limit - (time.monotonic() - begin)
            result = self._step(binary, step, left) if left > 0 else None
            if result is None:
                return Outcome(None, time.monotonic() - begin)
            of = f" of step {number}" if len(case.steps) > 1 else ""
            for what, content in zip(("exit code", "standard output", "standard error"), result):
                parts[what + of] = content if isinstance(content, bytes) else b"%d\n" % content
        seconds = time.monotonic() - begin
        for folder, inner, files in os.walk(self.folder):
            for name in [*inner, *files]:
                path = os.path.join(folder, name)
                what = "file " + os.path.relpath(path, self.folder)
                if os.path.islink(path):
                    parts[what] = os.readlink(path).encode()
                elif os.path.isfile(path):
                    with open(path, "rb") as file:
                        parts[what] = file.read()
                else:
                    parts[what] = b"folder or other\n"
        return Outcome(parts, seconds)


PACKED = re.compile(rb"\bH4sI[A-Za-z0-9+/=]{40,}")  # gzip in base64: the data of a page


def unpacked(content):
    """A page with its data as they are: durations in them change all that is packed."""
    return PACKED.sub(lambda found: gzip.decompress(base64.b64decode(found[0])), content)


def masked(content, masks):
    content = unpacked(content)
    for pattern, put in masks:
        content = re.sub(pattern, put, content)
    return without_seconds(content) if masks else content


def without_seconds(content):
    """A CSV table without what its columns of durations hold, whose names end in "seconds". They are counted from the end: a
    quoted text before them may have commas."""
    head, _, rows = content.partition(b"\n")
    names = head.split(b",")
    durations = [column - len(names) for column, name in enumerate(names) if re.fullmatch(rb"\w*seconds\r?", name)]
    if not durations:
        return content
    lines = [line.split(b",") for line in rows.split(b"\n")]
    for line in lines:
        for column in durations:
            if len(line) >= len(names):
                line[column] = b"0"
    return head + b"\n" + b"\n".join(b",".join(line) for line in lines)


EXCERPT = 20  # lines shown of a difference
WIDTH = 160  # characters shown of a line


def excerpt(old, new):
    """The first lines of a unified diff of two contents; of long lines the surroundings of the first difference."""
    lines = [content.decode("utf-8", errors="backslashreplace").splitlines() for content in (old, new)]
    if lines[0] == lines[1]:
        return ["(differs in line ends)"]
    first = next((number for number, pair in enumerate(zip(*lines)) if pair[0] != pair[1]), min(map(len, lines)))
    begin = max(0, first - 3)
    window = [part[begin:begin + 60] for part in lines]  # the diff of whole long files would take too long
    column = 0
    if all(len(part) > first for part in lines):
        column = max(0, len(os.path.commonprefix([part[first] for part in lines])) - WIDTH // 2)
    shown = difflib.unified_diff(*window, "old", "new", f"from line {begin + 1}", f"from line {begin + 1}", lineterm="")
    return [line if len(line) <= WIDTH else line[0] + "..." + line[1 + column:1 + column + WIDTH] for line in shown][:EXCERPT]


REPORT = re.compile(rb"^.*(ERROR: \w+Sanitizer|: runtime error: ).*$", re.M)  # of a sanitizer


def faults(outcome):
    """What a build with sanitizers must not do: (what, lines that show it) of each step that a signal ended (an assertion
    is one) or that a sanitizer reported."""
    found = []
    for what, content in outcome.parts.items():
        if what.startswith("exit code") and int(content) < 0:
            found.append((what, [f"ended by signal {-int(content)}"]))
        if what.startswith("standard error"):
            reported = REPORT.search(content)
            if reported:
                found.append((what, content[reported.start():].decode(errors="replace").splitlines()[:EXCERPT]))
    return found


def differences(old, new, masks=MASKS, relative=None):
    """What differs between two outcomes: (what, lines that show it) of each part. Given a relative tolerance, outcomes that differ
    by rounding alone have that `Rounding` instead."""
    if old.parts is None or new.parts is None:
        ended = "new" if new.parts is None else "old"
        return [("time", [f"the {ended} one did not end within the limit, the other one did"])]
    found, rounded = [], Rounding()
    for what in [*old.parts, *(what for what in new.parts if what not in old.parts)]:
        pair = old.parts.get(what), new.parts.get(what)
        if pair[0] == pair[1]:
            continue
        if None in pair:
            found.append((what, ["only the new one writes it" if pair[0] is None else "only the old one writes it"]))
            continue
        pair = masked(pair[0], masks), masked(pair[1], masks)
        if pair[0] != pair[1]:
            within = rounding(what, *pair, relative) if relative is not None else None
            if within:
                rounded.add(within)
            else:
                found.append((what, excerpt(*pair)))
    return rounded if rounded.numbers and not found else found
