"""Writes the types of the compiled module: a template whose @verb@ lines become the verb's keywords.

    write_stubs.py FOLDER TEMPLATE

FOLDER holds the package as it is imported; the stub lands in it.
"""

import importlib
import pathlib
import re
import sys


def declared(keywords):
    """A line for each keyword, as a stub has it."""
    for name, kind, usual, _ in keywords:
        yield f"{name}: {kind}{' | None' if usual == 'None' else ''} = {usual},"


def main(folder, template):
    sys.path.insert(0, str(folder.parent))
    module = importlib.import_module(f"{folder.name}._lyrefit")
    used = set()

    def keywords_of(place):
        used.add(place[2])
        return "\n".join(place[1] + line for line in declared(module._keywords[place[2]]))

    stub = re.sub(r"^( +)@(\w+)@$", keywords_of, template.read_text(), flags=re.MULTILINE)
    missing = set(module._keywords) - used
    if missing:
        sys.exit(f"{template}: no stub for {', '.join(sorted(missing))}")
    (folder / "_lyrefit.pyi").write_text(stub)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]))
