"""Cases of the pages of the repository: every command that a page shows to be run, after those whose files it reads."""

import re
import shlex
import zlib

from case import Case, Step

START = "    lyrefit "
FILLED_IN = re.compile(r"[\[\]|<>&$`]|\.\.\.|\b(CURVE|SET|ROWS|FILE|FIT|NAME|FOLDER|YEAR)\b|=[A-Z]\b| [A-Z]\b")  # placeholders, shells


def commands(text):
    """The commands that a page shows: their arguments, and what a comment says of them."""
    for line in text.replace("\\\n", " ").splitlines():
        if line.startswith(START) and line[len(START)].isalpha():
            command, _, comment = line[len(START):].partition(" #")
            if not FILLED_IN.search(command) and "needs" not in comment:
                yield tuple(shlex.split(command)), comment


def written(arguments):
    """The files that a command may write: what follows a flag, and is not a file of the repository."""
    return {word for flag, word in zip(arguments, arguments[1:]) if flag.startswith("--") and "." in word
            and not word.startswith(("-", "data/"))} | {arguments[-1] for flag in arguments[-2:-1] if flag == "--out"}


def page_cases(root):
    seen = set()
    pages = [root / "README.md", *(page for folder in (".github", "apps", "data", "lib", "tests")
                                   for page in sorted((root / folder).rglob("*.md")))]
    for page in pages:
        before = []  # (arguments, the steps that they need and they)
        for arguments, comment in commands(page.read_text(encoding="utf-8")):
            needed = []
            for earlier, steps in before:
                if written(earlier) & set(arguments):
                    needed += [step for step in steps if step not in needed]
            steps = [*needed, Step(arguments)]
            before.append((arguments, steps))
            name = f"pages/{page.relative_to(root).as_posix()}/{zlib.crc32(repr(steps).encode()):08x}"
            if name.rpartition("/")[2] not in seen:
                seen.add(name.rpartition("/")[2])
                yield Case(name, tuple(steps), seconds=5, full="takes a minute" in comment)
