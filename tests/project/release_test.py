#!/usr/bin/env python3
"""What a release says of itself agrees: version, change log, citation, records; and the forms for reports can be shown."""

import pathlib
import re
import unittest

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
GITHUB = ROOT / ".github"
SEMANTIC = re.compile(r"\d+\.\d+\.\d+")


def text(path):
    return (ROOT / path).read_text(encoding="utf-8")


def version():
    return re.search(r"^project\(lyrefit VERSION (\S+)", text("CMakeLists.txt"), flags=re.MULTILINE).group(1)


def citation_faults(citation):
    """What version 1.2.0 of the Citation File Format would refuse of a file of software with an entity as author."""
    required = {"cff-version", "message", "title", "authors"}
    allowed = required | {"abstract", "type", "version", "license", "keywords", "doi", "date-released", "url",
                          "repository-code", "references", "identifiers", "preferred-citation", "contact", "commit"}
    faults = [f"no {key}" for key in sorted(required - citation.keys())]
    faults += [f"unknown {key}" for key in sorted(citation.keys() - allowed)]
    faults += [f"{key} is no text" for key in ("cff-version", "message", "title", "version", "license")
               if not isinstance(citation.get(key, ""), str)]
    if citation.get("cff-version") != "1.2.0" or citation.get("type", "software") not in ("software", "dataset"):
        faults.append("cff-version or type")
    authors = citation.get("authors")
    if not authors or not all("name" in author or "family-names" in author for author in authors):
        faults.append("authors")
    return faults


def form_faults(form):
    """What GitHub would refuse of an issue form."""
    faults = [f"no {key}" for key in ("name", "description", "body") if not form.get(key)]
    ids = [field["id"] for field in form.get("body", []) if "id" in field]
    faults += [f"twice {field}" for field in set(ids) if ids.count(field) > 1]
    for field in form.get("body", []):
        kind, attributes = field.get("type"), field.get("attributes", {})
        if kind not in ("markdown", "textarea", "input", "dropdown", "checkboxes"):
            faults.append(f"type {kind}")
        elif not isinstance(attributes.get("value" if kind == "markdown" else "label"), str):
            faults.append(f"{field.get('id', kind)} has no text")
        elif kind == "dropdown" and not all(isinstance(option, str) for option in attributes.get("options") or [None]):
            faults.append(f"{field['id']} has options that are no text")
    if form.get("body") and all(field.get("type") == "markdown" for field in form["body"]):
        faults.append("nothing to fill in")
    return faults


class Release(unittest.TestCase):
    def test_the_change_log_has_this_version_and_its_day(self):
        headings = re.findall(r"^## (.*)$", text(".github/CHANGELOG.md"), flags=re.MULTILINE)
        self.assertEqual(headings[0], "Unreleased")
        self.assertRegex(headings[1], rf"^{re.escape(version())} - \d{{4}}-\d\d-\d\d$")
        numbers = [tuple(map(int, SEMANTIC.match(heading).group().split("."))) for heading in headings[1:]]
        self.assertEqual(numbers, sorted(numbers, reverse=True))

    def test_every_record_has_its_speeds_and_none_is_of_the_future(self):
        records = {folder.name for folder in (ROOT / "data" / "stable").iterdir() if folder.is_dir()}
        self.assertEqual(records, {file.stem for file in (ROOT / "data" / "speed").glob("[0-9]*.json")} & records)
        for record in records:
            self.assertLessEqual(tuple(map(int, record.split("."))), tuple(map(int, version().split("."))))
        self.assertIn(version(), records)

    def test_the_citation_is_of_this_version(self):
        citation = yaml.safe_load(text(".github/CITATION.cff"))
        self.assertEqual(citation_faults(citation), [])
        table = re.sub(r'"\n *"', "", text("lib/lyrefit/cite/references.cc"))
        for reference in citation["references"]:  # as `lyrefit cite` prints them
            for fact in (reference["title"], reference.get("doi", ""), *(one.get("family-names", "") for one in reference["authors"])):
                self.assertIn(fact, table)
        self.assertEqual(citation["version"], version())
        self.assertEqual(citation["authors"], [{"name": "The lyrefit authors"}])
        self.assertIn("the lyrefit authors", text("LICENSE"))

    def test_a_wrong_citation_is_refused(self):
        wrong = {"cff-version": 1.2, "title": "lyrefit", "authors": [{"nickname": "x"}], "colour": "red"}
        self.assertEqual(citation_faults(wrong), ["no message", "unknown colour", "cff-version is no text",
                                                  "cff-version or type", "authors"])

    def test_the_forms_can_be_shown(self):
        forms = [file for file in (GITHUB / "ISSUE_TEMPLATE").glob("*.yml") if file.name != "config.yml"]
        self.assertEqual(len(forms), 3)
        for file in forms:
            with self.subTest(file.name):
                self.assertEqual(form_faults(yaml.safe_load(file.read_text(encoding="utf-8"))), [])
        self.assertEqual(yaml.safe_load(text(".github/ISSUE_TEMPLATE/config.yml")), {"blank_issues_enabled": True})

    def test_a_wrong_form_is_refused(self):
        wrong = {"name": "A", "body": [{"type": "input", "id": "a", "attributes": {}},
                                       {"type": "dropdown", "id": "a", "attributes": {"label": "l", "options": [False]}},
                                       {"type": "slider"}]}
        self.assertEqual(form_faults(wrong), ["no description", "twice a", "a has no text",
                                              "a has options that are no text", "type slider"])


class Container(unittest.TestCase):
    """cmake/Containerfile; its RUN lines are run by cmake/bare.sh."""

    def test_it_copies_all_that_a_build_reads(self):
        copied = {part for line in re.findall(r"^COPY (?!--from)(.*) \S+$", text("cmake/Containerfile"), re.MULTILINE)
                  for part in line.split()}
        self.assertEqual([part for part in copied if not (ROOT / part).exists()], [])
        parts = re.search(r"^PARTS = \(([^)]*)\)", text("apps/python/setup.py"), re.MULTILINE)[1]
        for part in re.findall(r'"([^"]+)"', parts):
            self.assertTrue(any(part == name or part.startswith(name + "/") for name in copied), part)

    def test_it_runs_what_bare_runs(self):
        runs = re.findall(r"^RUN (.*)$", text("cmake/Containerfile"), re.MULTILINE)
        self.assertEqual(runs, ["/lyrefit/cmake/container.sh build", "/container.sh install /packages"])
        self.assertIn("'s/^RUN //p'", text("cmake/bare.sh"))


if __name__ == "__main__":
    unittest.main()
