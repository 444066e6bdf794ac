#!/usr/bin/env python3
"""Every link, picture, script and style of the site leads to a file of it, every anchor to an element of that page.

    links_test.py SITE

Links to other sites are not followed, but nothing may be loaded from one. The pages below cpp/ are Doxygen's: links into
them are tested, their own are not. First tries itself on pages with dead links.
"""

import html.parser
import pathlib
import sys
import tempfile
import urllib.parse

LOADED = {("img", "src"), ("script", "src"), ("link", "href"), ("iframe", "src"), ("source", "src"), ("object", "data")}


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("id", "name") and value:
                self.anchors.add(value)
            if (tag, name) in LOADED or (tag, name) == ("a", "href"):
                self.links.append((tag, value or ""))


def faults(site):
    """PAGE: LINK: what is wrong with it, for each."""
    pages = {path: Page(path) for path in sorted(site.rglob("*.html"))}
    for path, page in pages.items():
        where = path.relative_to(site)
        if where.parts[0] == "cpp":
            continue
        for tag, link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                if tag != "a" and parts.scheme != "data":
                    yield f"{where}: {link}: loaded from elsewhere"
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            if not target.is_file():
                yield f"{where}: {link}: no such file"
            elif parts.fragment and target in pages:
                if urllib.parse.unquote(parts.fragment) not in pages[target].anchors:
                    yield f"{where}: {link}: no such anchor"


def sees_faults():
    with tempfile.TemporaryDirectory() as folder:
        site = pathlib.Path(folder).resolve()
        (site / "a.html").write_text('<p id="here"><a href="b.html#there">1</a><a href="#here">2</a><a href="c.html">3</a>'
                                     '<a href="https://a.example/">4</a><img src="https://a.example/b.png">')
        (site / "b.html").write_text('<a href="a.html#here">1</a>')
        return [fault.split(": ")[-1] for fault in faults(site)] == ["no such anchor", "no such file", "loaded from elsewhere"]


if __name__ == "__main__":
    if not sees_faults():
        sys.exit("a dead link was not seen")
    root = pathlib.Path(sys.argv[1]).resolve()
    found = list(faults(root))
    print(*found, sep="\n")
    sys.exit(1 if found or not (root / "index.html").is_file() else 0)
