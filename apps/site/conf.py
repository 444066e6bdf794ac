"""Sphinx's settings. `build.py` fills the folder of sources and starts Sphinx."""

import os
import pathlib
import re
import sys

import lyrefit
import matplotlib

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import gallery  # noqa: E402

PARTS = pathlib.Path(os.environ["LYREFIT_SITE_PARTS"])

project = "lyrefit"
release = version = lyrefit.__version__
copyright = "the lyrefit authors, BSD 3-Clause"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.autosummary", "sphinx.ext.napoleon",
              "sphinx_gallery.gen_gallery", "nbsphinx", "sphinx_copybutton", "sphinx.ext.imgmath"]
exclude_patterns = ["**/sg_execution_times.rst", "gallery/*.ipynb"]
highlight_language = "text"
smartquotes = False  # it makes one dash of the two of a flag

myst_heading_anchors = 4
suppress_warnings = ["myst.header"]  # pages that begin below the level of a title

autosummary_generate = True
templates_path = [str(HERE / "templates")]
autodoc_typehints = "none"
napoleon_google_docstring = False
napoleon_use_rtype = False

html_theme = "sphinx_rtd_theme"
html_theme_options = {"navigation_depth": 3, "collapse_navigation": True, "style_external_links": False}
html_static_path = [str(PARTS / "source" / "_static")]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
html_title = f"lyrefit {release}"
html_copy_source = html_show_sourcelink = False
html_show_sphinx = False
copybutton_prompt_text = ">>> "
copybutton_selector = ":not(.prompt) > div.highlight pre"

nbsphinx_execute = "never"
nbsphinx_prolog = "The file: :download:`{{ env.docname }}.ipynb </{{ env.docname }}.ipynb>`"
nbsphinx_requirejs_path = ""  # by default both scripts come from other servers
html_math_renderer = "imgmath"


def use_style(*_):
    matplotlib.rc_file(HERE / "static" / "matplotlibrc")


def order(name):
    return gallery.ORDER.index(pathlib.Path(name).stem)


class Order:
    def __init__(self, folder):
        pass

    def __call__(self, name):
        return order(name)

    def __repr__(self):
        return "Order"


sphinx_gallery_conf = {
    "examples_dirs": str(PARTS / "examples"),
    "gallery_dirs": "gallery",
    "filename_pattern": ".*",
    "within_subsection_order": Order,
    "capture_repr": (),
    "reset_modules": ("matplotlib", use_style),
    "download_all_examples": False,
    "min_reported_time": 1e9,
    "show_signature": False,
    "abort_on_example_error": True,
    "thumbnail_size": (400, 280),
}


def keep_underscores(_app, _what, _name, _thing, _options, lines):
    """A name that ends in an underscore is no link, as it would be in the language of docstrings."""
    lines[:] = [re.sub(r"^:(param|type) (\w+)_:", r":\1 \2\\_:", line) for line in lines]


NUMBER = re.compile(r"(?<![\w.-])[-+]?\d[\d.]*(?:e?[-+]\d[\d.]*)*(?: %)?(?!\w)")


def keep_numbers(_app, _page, _template, context, _tree):
    """A number of a table does not break at a hyphen within it, nor before its percent sign."""
    def whole(text):
        return NUMBER.sub(lambda m: f'<span class="number">{m.group()}</span>' if re.search("[-+%]", m.group()) else m.group(), text)

    def of_cell(cell):
        return "".join(piece if piece.startswith("<") else whole(piece) for piece in re.split(r"(<[^>]*>)", cell.group()))

    if "body" in context:
        context["body"] = re.sub(r"<td.*?</td>", of_cell, context["body"], flags=re.S)


def setup(app):
    app.connect("html-page-context", keep_numbers)
    app.connect("autodoc-process-docstring", keep_underscores, priority=900)  # after Napoleon's
