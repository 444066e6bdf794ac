"""Cases of measurements: every file of the data folders by the verbs that read one, and pairs of files and folders."""

import zlib

from case import Case, Step

# Not read as measurements: pages, pictures, programs, packed files.
OTHER = {".md", ".py", ".svg", ".png", ".html", ".xz", ".gz", ".enc", ".sha256", ".sh", ".cff", ""}
NO_MEASUREMENTS = {"schema", "speed", "stable", "LICENSES", "contest"}  # folders of texts for programs
SWEEPS = 50  # most files of a folder, unless all are asked for

# What is done with a file: each verb with one of its variants, which the file's name chooses. A share of 4 is every
# fourth file, likewise.
OF_A_FILE = [
    ("fit", 1, "fit FILE --json fit.json --csv fit.csv", [
        "", "--plot fit.svg", "--model dd", "--model td --intervals symmetric", "--model auto", "--noise field --html fit.html",
        "--objective measured-current", "--loss huber --bounds wide", "--cells 60 --temperature-C 45 --irradiance-Wm2 850",
        "--skip-missing --as-is", "--floor --intervals none", "--area-cm2 1 --isc-A 0.04"]),
    ("diagnose", 1, "diagnose FILE --json diagnosis.json --csv diagnosis.csv --answers answers.json", [
        "", "--base dd", "--noise white", "--verbose", "--html diagnosis.html", "--plot diagnosis.svg", "--extend model.json",
        "--no-held-out --probability 0.6", "--cells 60 --temperature-C 45", "--as-is --skip-missing --area-cm2 1"]),
    ("translate", 1, "translate FILE --json translation.json --csv translation.csv", [
        "", "--html page.html", "--plot curve.svg", "--rated-W 300 --gamma -0.4", "--key-points e1036", "--to 600,40 --brief",
        "--draws 0", "--cells 60 --temperature-C 45 --irradiance-Wm2 850", "--technology c-Si --irradiance-from pyranometer"]),
    ("cell", 1, "cell FILE --json cell.json --csv cell.csv", [
        "", "--area-cm2 0.16", "--html cell.html", "--plot cell.svg", "--no-fit", "--cells 1 --temperature-C 25 --area-cm2 1"]),
    ("fit", 1, "fit FILE --list-columns", [""]),
    ("pack", 1, "pack FILE", ["--out packed.jsonl", "--out packed.csv", "--out -"]),
    ("batch", 4, "batch FILE --out results", [
        "", "--task diagnose --html plant.html", "--task cell", "--task field-test --pages failed --draws 100"]),
    ("trend", 4, "trend FILE --json trend.json --csv trend.csv", ["", "--html trend.html", "--plot trend.svg", "--append state"]),
    ("certify", 4, "certify FILE --effort 300 --json certificate.json", [
        "--models sd", "--models sd,dd --n-lower 0.5 --n-upper 4", "--models sd --objective solved-current"]),
]
LARGE = 100_000  # bytes of a file; larger ones are given to `batch` in a full comparison only
OF_TWO_FILES = ["cell FIRST SECOND --json cell.json --csv cell.csv", "diagnose FIRST SECOND --together --json diagnosis.json"]
ENDINGS = [(".csv", ".suns.csv"), ("_for.csv", "_rev.csv"), ("_fwd.csv", "_rev.csv"), ("_fw.csv", "_rv.csv"),
           ("_up.csv", "_down.csv"), ("light.csv", "dark.csv"), ("lit.csv", "dark.csv")]
OF_A_FOLDER = [
    "fit FOLDER --json fit.json --csv fit.csv --brief",
    "fit FOLDER --family desoto --search-curves 4 --fit-curves 8 --folds 2 --no-individual-fits --json family.json --csv family.csv",
    "diagnose FOLDER --no-held-out --json diagnosis.json",
    "cell FOLDER --json cell.json",
    "pack FOLDER --out packed.jsonl",
    "trend FOLDER --json trend.json",
    "batch FOLDER --out results --html plant.html",
]


def spread(items, most):
    """At most so many of a list, evenly spread over it."""
    return [items[number * len(items) // most] for number in range(most)] if len(items) > most else items


def _chosen(path, what, among):
    """A number below `among` that the name of a file chooses."""
    return zlib.crc32(f"{what} {path}".encode()) % among


def _case(verb, label, template, words, **more):
    arguments = tuple(words.get(word, word) for word in template.split())
    return Case(f"{verb}/{label}".replace(" ", "_"), (Step(arguments),), **more)


def measurements(folder):
    """The files of a folder, not of those in it, that may be measurements; what describes another file is none."""
    files = sorted(path for path in folder.iterdir() if path.is_file() and path.suffix not in OTHER)
    names = {path.name for path in files}
    return [path for path in files
            if not (path.suffix == ".json" and any(path.with_suffix(end).name in names for end in (".csv", ".txt")))]


def _of_a_file(path, shown):
    for verb, share, template, variants in OF_A_FILE:
        number = _chosen(shown, template, len(variants))
        rare = _chosen(shown, f"share {template}", share) > 0 or (verb == "batch" and path.stat().st_size > LARGE)
        what = "columns/" if "--list-columns" in template else ""
        yield _case(verb, what + shown, f"{template} {variants[number]}", {"FILE": shown}, full=rare)


def _of_two_files(path, shown):
    for one, other in ENDINGS:
        partner = path.name.removesuffix(one) + other
        if path.name.endswith(one) and partner != path.name and (path.parent / partner).is_file():
            second = shown.removesuffix(path.name) + partner
            for template in OF_TWO_FILES:
                verb = template.split()[0]
                yield _case(verb, f"{shown}+{partner}", template, {"FIRST": shown, "SECOND": second})


def sweep_cases(link, root, most):
    """The cases of a data folder, which commands see under the name `link`: of at most so many files of each folder."""
    folders = [root, *sorted(path for path in root.rglob("*") if path.is_dir())]
    for folder in folders:
        inside = folder.relative_to(root)
        files = measurements(folder)
        if not files or NO_MEASUREMENTS & set(inside.parts):
            continue
        for path in files if most is None else spread(files, most):
            shown = (link / path.relative_to(root)).as_posix()
            yield from _of_a_file(path, shown)
            yield from _of_two_files(path, shown)
        few = sum(path.stat().st_size for path in files) <= LARGE
        for template in OF_A_FOLDER:
            shown = (link / inside).as_posix()
            label = f"{shown}/" + ("family" if "--family" in template else "")
            yield _case(template.split()[0], label, template, {"FOLDER": shown}, full=not few, seconds=5)
