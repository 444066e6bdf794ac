"""Cases of a comparison: commands, one after another in one folder, and how they are written as text."""

import dataclasses
import re
import shlex
import zlib


@dataclasses.dataclass(frozen=True)
class Step:
    """One run of the command: its arguments, and the file that is its standard input, if any."""

    arguments: tuple
    standard_input: str = ""

    def shown(self, command="lyrefit"):
        """The step in shell syntax."""
        source = f" < {shlex.quote(self.standard_input)}" if self.standard_input else ""
        return " ".join([shlex.quote(str(command)), *map(shlex.quote, self.arguments)]) + source


@dataclasses.dataclass(frozen=True)
class Case:
    """Steps that run one after another in one folder, which holds nothing at first but data folders and `given` files."""

    name: str  # VERB/..., without blanks: stays as long as the steps stay
    steps: tuple
    given: tuple = ()  # of (file name, text)
    seconds: float = 0.5  # about what it takes: cases that take longest run first
    full: bool = False  # only in a full comparison

    @property
    def verb(self):
        return self.name.partition("/")[0]

    def shown(self, command="lyrefit"):
        return " ; ".join(step.shown(command) for step in self.steps)


def step_of(text):
    """The step of a text such as `fit - --brief < data/formats/plain.csv`."""
    words = shlex.split(text)
    source = ""
    if "<" in words:
        place = words.index("<")
        source = words[place + 1]
        del words[place:place + 2]
    return Step(tuple(words), source)


def expanded(text):
    """The texts that `{a|b}` stands for, without nesting."""
    found = re.search(r"\{([^{}]*)\}", text)
    if not found:
        return [text]
    return [whole for word in found.group(1).split("|")
            for whole in expanded(text[:found.start()] + word + text[found.end():])]


def cases_of(group, text, words, files):
    """The cases of a text, a line each. Steps are parted by ` ; `; `{a|b}` makes two cases; `~4` stands before one that
    takes about 4 s, `full` before one of a full comparison only; `#` begins a comment line. `words` are names that stand
    for a text. A case is given those of `files` (text by name) that it names."""
    names = re.compile(r"\b(" + "|".join(words) + r")\b")
    for line in text.splitlines():
        if not line or line.startswith("#"):
            continue
        mark, seconds, rest = re.fullmatch(r"(full )?(?:~(\d+) )?(.*)", line).groups()
        for whole in expanded(names.sub(lambda found: words[found.group(1)], rest)):
            steps = tuple(step_of(part) for part in whole.split(" ; "))
            named = {part for step in steps for argument in (*step.arguments, step.standard_input)
                     for part in re.split(r"[/=#]", argument)}
            given = tuple((name, content) for name, content in files.items() if name in named)
            yield Case(f"{group}/{zlib.crc32(whole.encode()):08x}", steps, given, float(seconds or 0.5), bool(mark))
