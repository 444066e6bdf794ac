"""What the tests share: where things are, the command, its JSON without clocks."""

import os
import pathlib
import re
import subprocess

ROOT = pathlib.Path(os.environ["LYREFIT_ROOT"])
DATA = ROOT / "data"


def command(*arguments, code=0):
    """Standard output of the command, or of a failed one what it says on the other."""
    run = subprocess.run([os.environ["LYREFIT_COMMAND"], *map(str, arguments)], capture_output=True, text=True)
    assert run.returncode == code, run.stderr
    return run.stdout if code == 0 else run.stderr


def without_clocks(json):
    """Every wall-clock time stands under a key that is called seconds."""
    return re.sub(r'"seconds": [^,\n]+', '"seconds": 0', json)
