#!/usr/bin/env python3
"""What is promised and what is experimental, and the comparison with the last record on small ones (cmake/stable)."""

import contextlib
import io
import json
import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "cmake" / "stable"))

import comparison
import declarations
import json_fields
import names
import promise
import reported
import stable


def broken(before, now):
    return comparison.compare(comparison.read(before), comparison.read(now))[0]


class Comparison(unittest.TestCase):
    FIT = "fit\toutput\tResult\t\nfit(model)\tinput\tstr | None\toptional\n"

    def test_what_stays_passes(self):
        self.assertEqual(comparison.compare(comparison.read(self.FIT), comparison.read(self.FIT)), ([], []))

    def test_additions_pass_and_are_named(self):
        now = self.FIT + "fit(seed)\tinput\tint\toptional\ntrend\toutput\tResult\t\ntrend(sweeps)\tinput\tstr\targument-1\n"
        lost, new = comparison.compare(comparison.read(self.FIT), comparison.read(now))
        self.assertEqual((lost, new), ([], ["fit(seed)", "trend", "trend(sweeps)"]))

    def test_what_goes_is_broken(self):
        self.assertEqual(broken(self.FIT, "fit\toutput\tResult\t\n"), ["fit(model) is gone"])

    def test_inputs_may_widen_and_not_narrow(self):
        self.assertEqual(broken("f(x)\tinput\tint\t\n", "f(x)\tinput\tint | list[int | str]\toptional\n"), [])
        self.assertEqual(broken("f(x)\tinput\tint | str\t\n", "f(x)\tinput\tint\t\n"), ["f(x) was int | str, is int"])

    def test_outputs_may_narrow_and_not_widen(self):
        self.assertEqual(broken("r.a\toutput\tnull | number\t\n", "r.a\toutput\tnumber\talways\n"), [])
        self.assertEqual(broken("r.a\toutput\tnumber\t\n", "r.a\toutput\tnull | number\t\n"),
                         ["r.a was number, is null | number"])

    def test_notes_may_not_be_lost(self):
        self.assertEqual(broken("r.a\toutput\tnumber\talways\n", "r.a\toutput\tnumber\t\n"), ["r.a is no longer always"])
        self.assertEqual(broken("f(x)\tinput\tint\toptional\n", "f(x)\tinput\tint\t\n"), ["f(x) is no longer optional"])
        self.assertEqual(broken("f(x)\tinput\tint\targument-1\n", "f(x)\tinput\tint\targument-2\n"),
                         ["f(x) is no longer argument-1"])

    def test_exact_types_and_kinds_stay(self):
        self.assertEqual(broken("S::a\texact\tdouble\t\n", "S::a\texact\tfloat\t\n"), ["S::a was double, is float"])
        self.assertEqual(broken("S::a\texact\tdouble\t\n", "S::a\toutput\tdouble\t\n"), ["S::a was exact, is output"])

    def test_a_new_required_input_breaks_old_calls_only(self):
        now = self.FIT + "fit(cells)\tinput\tint\t\nnew\toutput\tint\t\nnew(x)\tinput\tint\t\n"
        self.assertEqual(broken(self.FIT, now), ["fit(cells) is new and not optional"])

    def test_versions(self):
        too_low = comparison.too_low
        self.assertIn("raise the major", too_low("1.2.0", "1.3.0", ["x is gone"], []))
        self.assertEqual(too_low("1.2.0", "2.0.0", ["x is gone"], ["y"]), "")
        self.assertIn("raise the minor", too_low("1.2.0", "1.2.1", [], ["y"]))
        self.assertEqual(too_low("1.2.0", "1.3.0", [], ["y"]), "")
        self.assertEqual(too_low("1.2.0", "1.2.1", [], []), "")
        self.assertIn("below the last record", too_low("1.10.0", "1.9.0", [], []))

    def test_a_record_is_read_as_it_was_written(self):
        entries = {"a": comparison.Entry("exact"), "f(x)": comparison.Entry("input", "int", frozenset(["b", "a"]))}
        self.assertEqual(comparison.read(comparison.written(entries)), entries)


LISTED = promise.promised()
EXPERIMENTAL = "// Experimental: may change in a minor version (data/stable)."


def installed():
    """The headers that CMake installs, as they are included: those that say that they are public."""
    lib = ROOT / "lib"
    found = {file for file in (lib / "lyrefit").rglob("*.h")
             if re.search(r"^#define LYREFIT_PUBLIC |^namespace LYREFIT_PUBLIC ", file.read_text(encoding="utf-8"), re.MULTILINE)}
    found.update((lib / "lyrefit").glob("*.h"), (lib / "lyrefit").rglob("*.inc"))
    return {str(file.relative_to(lib)) for file in found}


def included(header):
    text = (ROOT / "lib" / header).read_text(encoding="utf-8")
    return set(re.findall(r'^#include "(lyrefit/[^"]+)"', text, flags=re.MULTILINE))


def comments_of(header, name):
    """The comments beside and above each declaration of a name in a header."""
    lines = (ROOT / "lib" / header).read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines):
        code, _, beside = line.partition("//")
        if re.search(rf"^(  )?\S.* {name}( =.*)?;|^\S.* {name}\(|^struct {name} ", code):
            above = number
            while lines[above - 1].lstrip().startswith("//"):
                above -= 1
            yield " ".join([*lines[above:number], beside])


def experimental_fields(schema, path=""):
    """The paths of the fields of a schema that say that they are experimental."""
    for name, field in schema.get("properties", {}).items():
        if "x-stability" in field:
            yield path + name
        yield from experimental_fields(field, f"{path}{name}.")
    if isinstance(schema.get("items"), dict):
        yield from experimental_fields(schema["items"], path.removesuffix(".") + "[].")


class Promised(unittest.TestCase):
    def test_exactly_the_headers_that_are_not_promised_say_so(self):
        headers = installed()
        self.assertGreater(len(headers), 100)
        self.assertEqual(set(LISTED["header"]) - headers, set(), "not installed")
        for header in headers:
            begin = (ROOT / "lib" / header).read_text(encoding="utf-8").partition("\n")[0]
            self.assertEqual(begin == EXPERIMENTAL, header not in LISTED["header"], header)

    def test_promised_headers_include_promised_headers_alone(self):
        for header, part in LISTED["header"].items():
            others = included(header) - LISTED["header"].keys()
            if "*" not in part.includes:
                self.assertEqual(others, set(part.includes), f"{header}: see promised.txt")
            self.assertTrue(all(part.includes.values()), header)

    def test_what_is_experimental_in_a_promised_header_says_so(self):
        for header, part in LISTED["header"].items():
            for name in part.left_out:
                comments = list(comments_of(header, name.rpartition("::")[2]))
                self.assertTrue(comments, f"{header} has no {name}")
                for comment in comments:
                    self.assertIn("xperimental", comment, f"{header}: {name}")

    def test_exactly_the_schemas_and_fields_that_are_not_promised_say_so(self):
        files = set((ROOT / "data" / "schema").glob("*.json"))
        self.assertEqual(LISTED["schema"].keys() - {file.name for file in files}, set())
        for file in files:
            schema = json.loads(file.read_text(encoding="utf-8"))
            if file.name == "common.json":  # describes no record
                self.assertNotIn("x-stability", file.read_text(encoding="utf-8"))
            elif file.name in LISTED["schema"]:
                self.assertNotIn("x-stability", schema, file.name)
                self.assertEqual(set(experimental_fields(schema)), LISTED["schema"][file.name].left_out, file.name)
            else:
                self.assertEqual(schema.get("x-stability"), "experimental", file.name)

    def test_an_open_record_is_of_this_version(self):
        lists = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
        version = re.search(r"^project\(lyrefit VERSION (\S+)", lists, flags=re.MULTILINE).group(1)
        for file in stable.RECORDS.glob("*/open.txt"):
            self.assertEqual(file.parent.name, version)

    def test_a_list_that_is_not_understood_is_refused(self):
        for text in ("fit\n", "  except a\n", "verb fit\nverb fit\n", "header a\n  includes b\n", "verb fit\n  drop a\n"):
            self.assertRaises(ValueError, promise.read, text)

    def test_parts_that_are_experimental_are_left_out(self):
        parts = promise.read(
            "# a list\nheader lyrefit/a.h\n  except lyrefit::A::b\n  except lyrefit::Read\n\nschema fit.json\n  except plan\n"
            "verb fit\n  except --light\npython fit\n  except light\npython One\n")
        entry = comparison.Entry("exact")

        def kept(select, kind, *found):
            return list(select(dict.fromkeys(found, entry), parts[kind]))

        self.assertEqual(kept(promise.of_headers, "header", "lyrefit::A", "lyrefit::A::b", "lyrefit::A::bc",
                              "lyrefit::Read(int)", "lyrefit::Reader"),
                         ["lyrefit::A", "lyrefit::A::bc", "lyrefit::Reader"])
        self.assertEqual(kept(promise.of_schemas, "schema", "fit", "fit.a", "fit.plan", "fit.plan.a", "fit.plan = b",
                              "fit.planned", "cell", "cell.a"),
                         ["fit", "fit.a", "fit.planned"])
        self.assertEqual(kept(promise.of_flags, "verb", "exit code 0", "fit", "fit --model sd", "fit(--light)",
                              "fit(--lights)", "cell", "cell(--json)"),
                         ["exit code 0", "fit", "fit --model sd", "fit(--lights)"])
        found = promise.of_python({
            "One": comparison.Entry("exact", "class Result"), "Two": comparison.Entry("exact", "class Result"),
            "fit": comparison.Entry("output", "Two | One"), "fit(light)": comparison.Entry("input", "str"),
            "fit(model)": comparison.Entry("input", "list[int | str] | Two | str"), "Two.a": entry, "cell": entry,
        }, parts["python"])
        self.assertEqual({name: found[name].type for name in found},
                         {"One": "class Result", "fit": "One", "fit(model)": "list[int | str] | str"})


class Records(unittest.TestCase):
    """Recording in a folder of its own."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.was = stable.ROOT, stable.RECORDS, stable.current
        stable.ROOT = pathlib.Path(self.folder.name)
        stable.RECORDS = stable.ROOT
        self.given = ["--build", self.folder.name, "--doxygen", "doxygen"]

    def tearDown(self):
        stable.ROOT, stable.RECORDS, stable.current = self.was
        self.folder.cleanup()

    def run_with(self, what, version, record):
        """Whether it goes well, and what it says where it does not."""
        stable.current = lambda given: {"flags.txt": comparison.read(record)}
        try:
            with contextlib.redirect_stdout(io.StringIO()):
                stable.main([what, "--version", version, *self.given])
        except SystemExit as refused:
            return str(refused)
        return ""

    def test_an_open_record_is_compared_and_may_be_written_anew_and_a_closed_one_may_not(self):
        both, one = "fit\texact\tverb\t\nman\texact\tverb\t\n", "fit\texact\tverb\t\n"
        self.assertEqual(self.run_with("record", "1.0.0", both), "")
        self.assertIn("it is open", self.run_with("check", "1.0.0", one))
        self.assertEqual(self.run_with("record", "1.0.0", one), "")
        self.assertEqual(self.run_with("check", "1.0.0", one), "")
        stable.mark("1.0.0").unlink()
        self.assertEqual(self.run_with("record", "1.0.0", both), "the record of 1.0.0 is closed")
        self.assertEqual(self.run_with("check", "1.0.0", both), "")
        self.assertEqual(self.run_with("record", "1.1.0", both), "")
        self.assertIn("raise the major version", self.run_with("record", "1.2.0", one))


class Sources(unittest.TestCase):
    def test_python(self):
        entries = names.python_names(
            "class Result(Base):\n"
            "    @property\n    def json(self) -> str: ...\n"
            "    def save(self, file: str, wide: bool = True) -> None: ...\n"
            "    def _hidden(self) -> None: ...\n"
            "@overload\ndef fit(curve: str, *, junctions: Literal[2]) -> Two: ...\n"
            "@overload\ndef fit(curve: str, *, junctions: int = 1) -> One: ...\n"
            "def _private() -> None: ...\n")
        self.assertEqual(
            comparison.written(entries),
            "Result\texact\tclass Base\t\nResult.json\toutput\tstr\t\nResult.save\toutput\tNone\t\n"
            "Result.save(file)\tinput\tstr\targument-1\nResult.save(wide)\tinput\tbool\targument-2 optional\n"
            "fit\toutput\tTwo | One\t\nfit(curve)\tinput\tstr\targument-1\nfit(junctions)\tinput\t2 | int\toptional\n")

    def test_json(self):
        with tempfile.TemporaryDirectory() as folder:
            common = {"$defs": {"node": {"type": "object", "required": ["value_A"], "properties": {
                "value_A": {"type": ["number", "null"]}, "next": {"$ref": "#/$defs/node"}}}}}
            fit = {"type": "object", "required": ["nodes"], "properties": {
                "nodes": {"type": "array", "items": {"$ref": "common.json#/$defs/node"}},
                "model": {"enum": ["sd", "dd"]},
                "either": {"anyOf": [{"type": "null"}, {"$ref": "common.json#/$defs/node"}]}}}
            (pathlib.Path(folder) / "common.json").write_text(json.dumps(common))
            (pathlib.Path(folder) / "fit.json").write_text(json.dumps(fit))
            found = json_fields.fields(folder)
        number = comparison.Entry("output", "null | number", frozenset(["always"]))
        self.assertEqual(found["fit.nodes"], comparison.Entry("output", "array", frozenset(["always"])))
        self.assertEqual(found["fit.nodes[].value_A"], number)
        self.assertEqual(found["fit.either.value_A"], number)
        self.assertEqual(found["fit.either"].type, "null | object")
        self.assertIn("fit.model = dd", found)
        self.assertIn("fit.nodes[].next", found)
        self.assertNotIn("common", found)

    def test_overloads_that_return_what_is_experimental_are_left_out(self):
        stub = ("class One: ...\nclass Two: ...\n@overload\ndef fit(curve: list, *, junctions: Literal[2]) -> Two: ...\n"
                "@overload\ndef fit(curve: str) -> One: ...\ndef name() -> str: ...\n")
        found = names.python_names(stub, promised={"One", "fit", "name"})
        self.assertEqual({name: entry.type for name, entry in found.items() if "." not in name},
                         {"One": "class ", "Two": "class ", "fit": "One", "fit(curve)": "str", "name": "str"})

    def test_a_record_inside_another_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "a.json").write_text('{"required": ["b"], "properties": {"b": {"$ref": "b.json"}}}')
            (pathlib.Path(folder) / "b.json").write_text('{"properties": {"c": {"type": "string"}}}')
            found = json_fields.fields(folder)
        self.assertEqual(found["a.b"], comparison.Entry("output", "b.json", frozenset(["always"])))
        self.assertEqual(sorted(found), ["a", "a.b", "b", "b.c"])

    def test_flags(self):
        entries = names.flags_of_help(
            "fit", "Usage\n\nPositionals:\n  CURVE TEXT ... REQUIRED     a table\n\nOptions:\n"
                   "  -h,--help                   help\n  --bound P=LOWER:UPPER ...   range\n")
        self.assertEqual(
            comparison.written(entries),
            "fit\texact\tverb\t\nfit(--bound)\tinput\tvalue\toptional several\nfit(--help)\tinput\talone\toptional\n"
            "fit(-h)\tinput\talone\toptional\nfit(CURVE)\tinput\ttext\tseveral\n")
        values = names.flag_values("    'fit --model') words='sd dd' ;;\n    'fit --kernel') words='portable' ;;\n")
        self.assertEqual(set(values), {"fit --model sd", "fit --model dd"})

    def test_parameters_of_reports_and_effects(self):
        report = {"parameters": {"resistance_series": {"symbol": "Rs", "unit": "ohm", "refined": 0.3}}}
        explained = (
            "partial shading (shading)\n  equation      V = 1\n\n  parameter  bounds        meaning (unit in reports)\n"
            "  d          0 to 0.999    shading_depth, part of the light that the shaded cells miss (see\n"
            "                           the page)\n"
            "  Vb         0.1 to 1.2    bypass_voltage, drop of a bypass diode\n                           at Isc (V)\n"
            "  Bounds are of the equation's own units.\n")
        entries = {**reported.of_report("fit", report), **reported.of_explanation("shading", explained)}
        self.assertEqual({name: entry.type for name, entry in entries.items()}, {
            "fit: parameters.resistance_series": "Rs [ohm]", "effect: shading.d": "shading_depth []",
            "effect: shading.Vb": "bypass_voltage [V]"})

    @unittest.skipUnless(stable.shutil.which("doxygen"), "doxygen is not installed")
    def test_headers(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            header = root / "lib" / "lyrefit" / "sample.h"
            header.parent.mkdir(parents=True)
            header.write_text(
                "namespace lyrefit {\nenum class Kind { kOne };\nstruct Options {\n  int seed = 0;\n};\n"
                "double Fit(const Options& options, int times = 1);\nclass Closed {\n public:\n"
                "  virtual int Next() = 0;\n\n private:\n  int hidden_;\n};\n}\n")
            (root / "Doxyfile").write_text("QUIET = YES\nGENERATE_LATEX = NO\n")
            found = declarations.declarations("doxygen", root / "Doxyfile", root, [str(header)])
        self.assertEqual(
            {name: entry.type for name, entry in found.items()},
            {"lyrefit/sample.h": "header", "lyrefit::Kind": "enum", "lyrefit::Kind::kOne": "value",
             "lyrefit::Options": "struct", "lyrefit::Options::seed": "variable int", "lyrefit::Closed": "class",
             "lyrefit::Closed::Next()": "int pure-virtual", "lyrefit::Closed(override Next)": "",
             "lyrefit::Fit(const Options &)": "double", "lyrefit::Fit(const Options &, int)": "double"})


if __name__ == "__main__":
    unittest.main()
