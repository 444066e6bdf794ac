"""Pages of Markdown as Doxygen's: the first is the main page, a module's is its topic, others are pages."""

import posixpath
import re

from markdown_links import LINK, PICTURE, pieces

MODULE = re.compile(r"lib/lyrefit/([a-z]+)/README\.md$")


class Pages:
    """The pages of the reference, which lead to each other; what leads out of them is left as its text."""

    def __init__(self, paths):
        self.main = paths[0] if paths else ""
        self.names = {path: self.name_of(path) for path in paths}

    def name_of(self, path):
        module = MODULE.search(path)
        return module.group(1) if module else "page_" + re.sub(r"\W", "_", path)

    def link(self, path, text, target):
        if re.match(r"\w+:", target):
            return f"[{text}]({target})"
        place, _, _ = target.partition("#")
        whole = posixpath.normpath(posixpath.join(posixpath.dirname(path), place)) if place else path
        if whole == self.main:
            return f'\\ref index "{text}"'
        return f'\\ref {self.names[whole]} "{text}"' if whole in self.names else text

    def picture(self, found):
        """One of the main page's, which the Doxyfile copies beside it."""
        return f'<img src="{posixpath.basename(found.group(2))}" alt="{found.group(1)}"/>'

    def filtered(self, path, text):
        first, _, rest = text.replace("*/", "* /").partition("\n")
        title = first.strip("# /")
        head = f"\\mainpage {title}"
        if path != self.main:
            head = f"\\{'defgroup' if MODULE.search(path) else 'page'} {self.names[path]} {title}"
        out = [head + "\n"]
        for code, piece in pieces(rest):
            if not code:
                if path == self.main:  # its sections would stand in the menu, above the modules
                    piece = re.sub(r"^##+ (.*)", r"<h2>\1</h2>", piece, flags=re.M)
                piece = PICTURE.sub(self.picture if path == self.main else "", piece)
                piece = LINK.sub(lambda m: self.link(path, m.group(1), m.group(2)), piece)
                piece = "".join(p if p.startswith("`") else re.sub(r"@|<(?!/?h2>|img |!--)", r"\\\g<0>", p)
                                for p in re.split(r"(`[^`]*`)", piece))
            out.append(piece)
        page = "/**\n" + "".join(out) + "\n*/\n"
        return page + "/** \\namespace lyrefit\nAll of lyrefit: its modules are the topics. */\n" * (path == self.main)
