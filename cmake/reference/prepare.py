#!/usr/bin/env python3
"""What Doxygen reads: the public headers with their comments as its own, and the pages of the modules as its topics.

    prepare.py --root PROJECT --out FOLDER LIST

LIST names headers and pages of Markdown of the project, one a line, pages first and in the order of the menu. Headers
keep their place below FOLDER, which is emptied before; all pages become its pages.dox.
"""

import argparse
import pathlib
import shutil

from header_comments import Header, Known
from markdown_pages import Pages


def names(path):
    rows = (line.split(None, 1) for line in path.read_text(encoding="utf-8").splitlines())
    return {row[0]: row[1].strip() for row in rows if len(row) == 2 and row[0] != "#"}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", type=pathlib.Path, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("list", type=pathlib.Path)
    given = parser.parse_args()
    files = [pathlib.Path(line) for line in given.list.read_text(encoding="utf-8").splitlines()]
    texts = {file.relative_to(given.root): file.read_text(encoding="utf-8") for file in files}
    headers = {path: text for path, text in texts.items() if path.suffix == ".h"}
    known = Known(headers.values(), names(pathlib.Path(__file__).parent / "names.txt"))
    pages = Pages([str(path) for path in texts if path.suffix == ".md"])
    shutil.rmtree(given.out, ignore_errors=True)
    given.out.mkdir(parents=True)
    read = [pages.filtered(str(path), text) for path, text in texts.items() if path not in headers]
    (given.out / "pages.dox").write_text("\n".join(read), encoding="utf-8")
    for path, text in headers.items():
        (given.out / path).parent.mkdir(parents=True, exist_ok=True)
        (given.out / path).write_text(Header(str(path), text, known).filtered(), encoding="utf-8")


if __name__ == "__main__":
    main()
