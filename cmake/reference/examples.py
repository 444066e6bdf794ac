#!/usr/bin/env python3
"""The examples of headers and pages, to be compiled and run.

    examples.py --root PROJECT cpp FILE    writes all C++ as one unit into FILE
    examples.py --root PROJECT run PROGRAM    runs the whole programs in what was made of that file
    examples.py --root PROJECT python PAGE...    runs each page's Python, top to bottom, in a folder of its own

C++ stands in the comments of public headers, indented by two further blanks, and in pages between ```cpp and ```;
Python between ```python and ```. A whole program has a `main`; of other C++ it counts that it compiles. Programs are run
in an empty folder, in which `data` leads to the project's, and must end well and have printed something: what stands
below them on the page between ```text and ```, if there is such a block. Python that needs a module which is not installed is left out, and that is said.
"""

import argparse
import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from header_comments import COMMENT, is_code, shown_as_it_stands


def public_headers(root):
    """The headers that are installed: those that say that they are public (base/public.h), and those that include them."""
    lib = root / "lib/lyrefit"
    headers = [file for file in sorted(lib.rglob("*.h"))
               if file.parent == lib or "namespace LYREFIT_PUBLIC " in file.read_text(encoding="utf-8")]
    return [*headers, lib / "base/public.h"]


def of_header(text):
    """Pieces of C++ in the comments of a header, each with the line on which it begins."""
    lines, number = text.split("\n"), 0
    while number < len(lines):
        last = number
        while last < len(lines) and COMMENT.match(lines[last]):
            last += 1
        texts = [re.sub(r"^\s*// ?", "", line) for line in lines[number:last]]
        shown, start = shown_as_it_stands(texts), 0
        while start < len(texts):
            end = start
            while end < len(texts) and shown[end]:
                end += 1
            piece = "\n".join(line[2:] for line in texts[start:end])
            if end > start and is_code(piece):
                yield number + start + 1, piece
            start = max(end, start + 1)
        number = max(last, number + 1)


def of_page(text, language):
    """Pieces of one language in a page of Markdown, each with the line on which it begins."""
    for found in re.finditer(rf"^```{language}\n(.*?)^```", text, re.M | re.S):
        yield text[:found.start(1)].count("\n") + 1, found.group(1)


def printed(text):
    """What a page shows below a piece of C++ as its output, by the line on which the piece begins."""
    shown = re.finditer(r"^```cpp\n((?:(?!```).*\n)*)```\n\n```text\n((?:(?!```).*\n)*)```$", text, re.M)
    return {text[:found.start(1)].count("\n") + 1: found.group(2) for found in shown}


def unit(root):
    """All C++ as one unit, and its whole programs: the output that is shown of each by its name, "" where none is."""
    includes, pieces, programs = [], [], {}
    places = [(path, of_header(path.read_text(encoding="utf-8"))) for path in public_headers(root)]
    pages = [root / "README.md", *(p for part in ("lib", "apps", "data", "tests") for p in sorted((root / part).rglob("*.md")))]
    places += [(path, of_page(path.read_text(encoding="utf-8"), "cpp")) for path in pages]
    for path, found in places:
        outputs = printed(path.read_text(encoding="utf-8"))
        for line, code in found:
            place = path.relative_to(root)
            name = re.sub(r"\W", "_", f"{place}_{line}")
            if place.suffix == ".h":
                includes.append(f'#include "{place.relative_to("lib")}"')
            includes += re.findall(r"^#include .*", code, re.M)
            code = re.sub(r"^#include .*", "", code, flags=re.M)
            if re.search(r"\bint main\(", code):
                programs[name] = outputs.get(line, "")
                code = re.sub(r"\bint main\(\) \{", "int Main() {", code)
                code = re.sub(r"\}\s*$", "  return 0;\n}\n", code)
            else:
                code = code.rstrip()
                code = f"using namespace lyrefit;\nvoid Compiles() {{\n{code if code.endswith((';', '}')) else code + ';'}\n}}"
            pieces.append(f'namespace {name} {{\n#line {line} "{place}"\n{code}\n}}\n')
    calls = "".join(f'  if (std::strcmp(argv[1], "{name}") == 0) return {name}::Main();\n' for name in programs)
    if not programs:
        sys.exit("no example found: is the mark of one another?")
    text = ("#include <cstring>\n" + "\n".join(sorted(set(includes))) + "\n\n" + "\n".join(pieces) +
            "\nint main(int argc, char** argv) {\n  if (argc != 2) return 2;\n" + calls + "  return 2;\n}\n")
    return text, programs


def run(root, program):
    for name, shown in unit(root)[1].items():
        with tempfile.TemporaryDirectory() as folder:
            os.symlink(root / "data", pathlib.Path(folder) / "data")
            ended = subprocess.run([program, name], cwd=folder, capture_output=True, text=True, check=False)
        if ended.returncode or not ended.stdout:
            sys.exit(f"{name} ends with {ended.returncode}:\n{ended.stdout}{ended.stderr}")
        if shown and ended.stdout != shown:
            sys.exit(f"{name} prints\n{ended.stdout}where the page shows\n{shown}")
        print(f"{name}: {len(ended.stdout)} bytes printed")


def python(root, pages):
    ran = 0
    for page in pages:
        pieces = list(of_page((root / page).read_text(encoding="utf-8"), "python"))
        if not pieces:
            sys.exit(f"{page} has no Python: is its mark another?")
        missing = {name for _, code in pieces for name in re.findall(r"^(?:import|from) (\w+)|^(\w+)\.", code, re.M)
                   for name in name if name and importlib.util.find_spec(name) is None}
        if missing:
            print(f"SKIPPED: {page} needs {', '.join(sorted(missing))}")
            continue
        script = "\n".join("\n" * (line - 1 - sum(c.count("\n") for _, c in pieces[:k]) - k) + code
                           for k, (line, code) in enumerate(pieces))
        with tempfile.TemporaryDirectory() as folder:
            os.symlink(root / "data", pathlib.Path(folder) / "data")
            if subprocess.run([sys.executable, "-c", script], cwd=folder, check=False).returncode:
                sys.exit(f"{page}: its Python does not run (see above)")
        ran += len(pieces)
    print(f"{ran} pieces of Python run")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, required=True)
    parser.add_argument("what", choices=("cpp", "run", "python"))
    parser.add_argument("files", nargs="+")
    given = parser.parse_args()
    root = given.root.resolve()
    if given.what == "cpp":
        pathlib.Path(given.files[0]).write_text(unit(root)[0], encoding="utf-8")
    elif given.what == "run":
        run(root, pathlib.Path(given.files[0]).resolve())
    else:
        python(root, given.files)


if __name__ == "__main__":
    main()
