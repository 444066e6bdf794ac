"""Examples and notebooks of the site: their order, notebooks with outputs, an archive of all with their data."""

import json
import pathlib
import re
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "apps" / "python" / "examples"
ORDER = ("fit", "bounds", "two_diodes", "family", "matrix", "cell", "hysteresis", "diagnose", "references", "trend",
         "plant", "translate", "certify", "compare", "paper", "own_effect")
NOTEBOOKS = ("fit", "cell", "diagnose", "trend", "compare")
WHERE = "It runs in the folder of `lyrefit-examples.zip <../_static/lyrefit-examples.zip>`__, which has its data."
PANDAS = " It needs pandas (the extra ``frames`` of the wheel)."


def stage(folder):
    """The examples of the gallery with its head, where sphinx-gallery finds them; each says where its data are and what it needs."""
    folder.mkdir(parents=True)
    for name in ORDER:
        text = (EXAMPLES / f"{name}.py").read_text(encoding="utf-8")
        told = WHERE + (PANDAS if re.search(r"^import pandas|frame\(", text, re.M) else "")
        (folder / f"{name}.py").write_text(text.replace('\n"""\n', f'\n\n{told}\n"""\n', 1), encoding="utf-8")
    head = (pathlib.Path(__file__).parent / "gallery.rst").read_text(encoding="utf-8")
    (folder / "README.rst").write_text(head, encoding="utf-8")


def notebook(name):
    """A notebook of an example, run."""
    import nbclient
    import nbformat
    from sphinx_gallery.gen_gallery import DEFAULT_GALLERY_CONF
    from sphinx_gallery.notebook import jupyter_notebook
    from sphinx_gallery.py_source_parser import split_code_and_text_blocks

    _, blocks = split_code_and_text_blocks(str(EXAMPLES / f"{name}.py"))
    made = nbformat.reads(json.dumps(jupyter_notebook(blocks, DEFAULT_GALLERY_CONF | {"first_notebook_cell": None}, str(EXAMPLES))), as_version=4)
    made.cells[0].source = re.sub("^# .*", r"\g<0> (notebook)", made.cells[0].source, count=1, flags=re.M)  # told from the example's page
    nbclient.NotebookClient(made, timeout=600, kernel_name="python3", record_timing=False).execute()
    return nbformat.writes(made)


def archive(file, notebooks):
    """All examples and notebooks with `data/`, which they and commands of the pages read; the same bytes every time."""
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as packed:
        def add(name, content):
            packed.writestr(zipfile.ZipInfo(f"lyrefit-examples/{name}", (2000, 1, 1, 0, 0, 0)), content, zipfile.ZIP_DEFLATED)

        for name in ORDER:
            add(f"{name}.py", (EXAMPLES / f"{name}.py").read_bytes())
        for name, text in notebooks.items():
            add(f"{name}.ipynb", text)
        for path in [ROOT / "LICENSE", *sorted((ROOT / "data").rglob("*"))]:
            if path.is_file() and path.suffix != ".pyc":
                add(path.relative_to(ROOT).as_posix(), path.read_bytes())
