#!/usr/bin/env python3
"""Puts the page that needs no server into a site that is built.

    offline_page.py PAGE SITE

PAGE is what cmake/web.sh makes. The first line of the site's index leads to it and says its size; without the file, how to
build it.
"""

import pathlib
import re
import shutil
import sys

NAME = "lyrefit.html"
LINE = re.compile(r'<p id="offline-page">.*?</p>', re.S)


def sentence(page):
    if page.is_file():
        return (f'<strong>Any computer: <a href="_static/{NAME}">open lyrefit in your browser</a></strong>, one file of '
                f"{page.stat().st_size / 1e6:.1f} MB that needs no installation, no server and no network: drop the file of your curve "
                f'tracer. <a href="_static/{NAME}" download>Download it</a> to keep it.')
    return ("Any computer: one file that your browser opens, without installation, server or network. This copy of the site was made "
            "without it: <code>cmake/web.sh --build</code> builds it, and <code>cmake/site.sh</code> takes it in.")


def put(page, site):
    if page.is_file():
        shutil.copyfile(page, site / "_static" / NAME)
    index = site / "index.html"
    text, count = LINE.subn(lambda found: f'<p id="offline-page">{sentence(page)}</p>', index.read_text(encoding="utf-8"))
    if count != 1:
        sys.exit(f"{index}: {count} lines for the page that needs no server, expected one")
    index.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    put(*(pathlib.Path(path) for path in sys.argv[1:]))
